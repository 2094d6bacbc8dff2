#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// Smallest and largest value of each block of 4 x 4 x 4 cells. Block (a, b, c) bounds every trilinear value
/// v(x) with 4a <= x < 4a + 4 (likewise y, z), so it spans the voxels 4a .. 4a + 4; what lies outside the
/// grid is clamped to it.
struct BrickRanges {
  static constexpr int edge = 4;
  glm::ivec3 count{0};
  std::vector<float> low, high;  ///< real values, i fastest
};

BrickRanges brickRanges(const Volume& volume);

}  // namespace volumen
