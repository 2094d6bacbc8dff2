#include "viewer/recipe/ball.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace volumen {

namespace {

double distanceToLine(glm::dvec3 p, glm::dvec3 from, glm::dvec3 to) {
  const glm::dvec3 along = to - from;
  const double square = glm::dot(along, along);
  const double t = square > 0 ? std::clamp(glm::dot(p - from, along) / square, 0.0, 1.0) : 0;
  return glm::distance(p, from + t * along);
}

}  // namespace

void addCapsule(BitMask& mask, glm::dvec3 from, glm::dvec3 to, double radiusMm) {
  const VoxelGeometry& grid = mask.geometry();
  // Rows of L^-1: how many voxels along an axis a mm can be.
  const glm::dmat3 steps = glm::transpose(grid.voxelFromPatientStep());
  const glm::dvec3 a = grid.voxelFromPatient(from), b = grid.voxelFromPatient(to);
  glm::ivec3 low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = radiusMm * glm::length(steps[axis]), last = grid.size[axis] - 1;
    low[axis] = int(std::clamp(std::ceil(std::min(a[axis], b[axis]) - reach), 0.0, last + 1));
    high[axis] = int(std::clamp(std::floor(std::max(a[axis], b[axis]) + reach), -1.0, last));
  }
  for (int k = low.z; k <= high.z; ++k)
    for (int j = low.y; j <= high.y; ++j)
      for (int i = low.x; i <= high.x; ++i)
        if (distanceToLine(grid.patientFromVoxel({i, j, k}), from, to) <= radiusMm) mask.set({i, j, k});
}

}  // namespace volumen
