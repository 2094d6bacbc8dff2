#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace volumen {

/// Where packets of rays must look: of the box around one, whose lower corner lies in a block and that
/// reaches some blocks farther, whether it meets a visible block.
struct EmptySpaceMap {
  int shift = 2;  ///< a block's edge is 1 << shift voxels
  glm::ivec3 count{0};
  /// How far, in voxels, a packet may get in the steps of one look; `reach` provides for it. Four steps of
  /// the longest that a pilot tries first.
  static constexpr float longestLook = 2.25f;
  int reach = 1;  ///< blocks that the largest boxes reach farther along each axis
  /// Layers, with 4 readable bytes behind the last. Their rows along i are padded to rowBlocks(). The first,
  /// a byte a block, is of boxes that reach a = 0 or 1 block farther along each axis: bit a_x + 2 a_y + 4
  /// a_z. The others, a bit a block, are of boxes that reach up to reach - 1 (from a reach of 3 on) and up to
  /// `reach` blocks (from 2 on): block n of the first layer is bit n % 8 of byte n / 8.
  std::vector<std::uint8_t> near;

  int layers() const { return reach < 3 ? reach : 3; }
  int rowBlocks() const { return (count.x + 7) / 8 * 8; }
  /// Where a layer begins in `near`.
  std::size_t layerAt(int layer) const {
    const std::size_t blocks = std::size_t(rowBlocks()) * count.y * count.z;
    return layer == 0 ? 0 : blocks + (layer - 1) * blocks / 8;
  }
  std::size_t bytes() const { return near.size(); }
};

/// Of blocks of `edge`, a power of two. `visible`: one entry a block, not 0 where it holds a visible value.
/// `reach` is at least 1. `memory`: a map that is no longer needed, whose memory is used again.
EmptySpaceMap makeEmptySpaceMap(int edge, glm::ivec3 count, const std::vector<std::uint8_t>& visible,
                                int reach, EmptySpaceMap memory = {});

}  // namespace volumen
