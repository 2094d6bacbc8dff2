#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// Smallest and largest value of each block of 8 x 8 x 8 cells. Block (a, b, c) bounds every trilinear value
/// v(x) with 8a <= x < 8a + 8 (likewise y, z), so it spans the voxels 8a .. 8a + 8; what lies outside the
/// grid is clamped to it.
struct BrickRanges {
  static constexpr int edge = 8;
  glm::ivec3 count{0};
  std::vector<float> low, high;  ///< real values, i fastest
};

BrickRanges brickRanges(const Volume& volume);

}  // namespace volumen
