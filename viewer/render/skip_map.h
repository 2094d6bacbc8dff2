#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace volumen {

/// Where packets of rays must look: blocks of 4 x 4 x 4 voxels, i fastest.
struct SkipMap {
  static constexpr int edge = 4;
  glm::ivec3 count{0};
  /// Not 0 where the block or any other up to so many blocks farther along each axis is visible; all that a
  /// box of rays whose lower corner lies in the block can meet. First for reach - 1 blocks, then for reach;
  /// with 4 readable bytes behind the last.
  std::vector<std::uint8_t> near;
  int reach = 1;  ///< blocks
  std::size_t bytes() const { return near.size(); }
};

/// `visible`: one entry a block, not 0 where it holds a visible value. `reach` is at least 1. `memory`: a map
/// that is no longer needed, whose memory is used again.
SkipMap makeSkipMap(glm::ivec3 count, const std::vector<std::uint8_t>& visible, int reach,
                    SkipMap memory = {});

}  // namespace volumen
