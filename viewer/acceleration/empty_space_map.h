#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace volumen {

/// Tells where packets of rays must be sampled: whether the box around a packet meets a visible block. The
/// box starts in the block of its lower corner and extends some blocks farther.
struct EmptySpaceMap {
  int shift = 2;  ///< The edge of a block is 1 << shift voxels.
  glm::ivec3 count{0};
  /// Longest move of a packet during one look, in voxels; `reach` allows for it. It covers four of the
  /// longest steps that a pilot tries first.
  static constexpr float longestLook = 2.25f;
  int reach = 1;  ///< Blocks that the largest boxes extend farther along each axis.
  /// The layers one after another, with 4 readable bytes behind the last. Rows along i are padded to
  /// rowBlocks().
  /// The first layer has one byte per block, for boxes that extend a = 0 or 1 blocks along each axis: bit a_x
  /// + 2 a_y + 4 a_z. The other layers have one bit per block: block n of the first layer is bit n % 8 of
  /// byte n / 8. They are for boxes that extend up to reach - 1 blocks (if reach >= 3) and up to `reach`
  /// blocks (if reach >= 2).
  std::vector<std::uint8_t> near;

  int layers() const { return reach < 3 ? reach : 3; }
  int rowBlocks() const { return (count.x + 7) / 8 * 8; }
  /// Returns where a layer begins in `near`.
  std::size_t layerAt(int layer) const {
    const std::size_t blocks = std::size_t(rowBlocks()) * count.y * count.z;
    return layer == 0 ? 0 : blocks + (layer - 1) * blocks / 8;
  }
  std::size_t bytes() const { return near.size(); }
};

/// Makes the map for blocks of `edge` voxels, a power of two. `visible` has one entry per block, not 0 if the
/// block holds a visible value. `reach` is at least 1. `memory`: an unused map whose memory is reused.
EmptySpaceMap makeEmptySpaceMap(int edge, glm::ivec3 count, const std::vector<std::uint8_t>& visible,
                                int reach, EmptySpaceMap memory = {});

}  // namespace volumen
