#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace volumen {

/// Where packets of rays must look: of the box around one, whose lower corner lies in a block of 4 x 4 x 4
/// voxels and that reaches some blocks farther, whether it meets a visible block.
struct SkipMap {
  static constexpr int edge = 4;
  glm::ivec3 count{0};
  int reach = 1;  ///< blocks that the largest boxes reach farther along each axis
  /// Layers of a byte a block, i fastest, with 4 readable bytes behind the last. The first is of boxes that
  /// reach a = 0 or 1 block farther along each axis: bit a_x + 2 a_y + 4 a_z. The others are of boxes that
  /// reach up to reach - 1 (from a reach of 3 on) and up to `reach` blocks (from 2 on): all bits or none.
  std::vector<std::uint8_t> near;
  int layers() const { return reach < 3 ? reach : 3; }
  std::size_t bytes() const { return near.size(); }
};

/// `visible`: one entry a block, not 0 where it holds a visible value. `reach` is at least 1. `memory`: a map
/// that is no longer needed, whose memory is used again.
SkipMap makeSkipMap(glm::ivec3 count, const std::vector<std::uint8_t>& visible, int reach,
                    SkipMap memory = {});

}  // namespace volumen
