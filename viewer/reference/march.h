#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "viewer/reference/ray.h"

namespace volumen::reference {

/// A straight piece of a ray inside one cell: positions within the cell (voxels) are start + s move, s = 0 ..
/// 1.
struct CellPiece {
  glm::ivec3 cell;
  glm::dvec3 start, move;
  double lengthMm;
};

/// Calls visit(CellPiece) for the cells along the ray, front to back, while it returns true. Cells lie
/// between voxel centres; -1 and n - 1 are the half-voxel borders.
template <class Visit>
void marchCells(const VoxelGeometry& geometry, const Ray& ray, Interval interval, Visit visit) {
  const glm::dvec3 start = geometry.voxelFromPatient(ray.origin);
  const glm::dvec3 slope = geometry.voxelFromPatientStep() * ray.direction;  // Voxels per mm.
  const auto at = [&](double t) { return start + t * slope; };

  glm::dvec3 plane, crossing;  // Per axis: the next plane of voxel centres and its t.
  for (int a = 0; a < 3; ++a) {
    const double x = at(interval.t0)[a];
    plane[a] = slope[a] > 0 ? std::floor(x) + 1 : std::ceil(x) - 1;
    crossing[a] = slope[a] != 0 ? (plane[a] - start[a]) / slope[a] : std::numeric_limits<double>::infinity();
  }
  for (double t = interval.t0; t < interval.t1;) {
    const double next = std::min({crossing.x, crossing.y, crossing.z, interval.t1});
    if (next > t) {
      const glm::ivec3 cell =
          glm::clamp(glm::ivec3(glm::floor(at((t + next) / 2))), glm::ivec3(-1), geometry.size - 1);
      if (!visit(CellPiece{cell, at(t) - glm::dvec3(cell), (next - t) * slope, next - t})) return;
      t = next;
    }
    for (int a = 0; a < 3; ++a) {
      if (crossing[a] > t) continue;
      plane[a] += slope[a] > 0 ? 1 : -1;
      crossing[a] = (plane[a] - start[a]) / slope[a];
    }
  }
}

}  // namespace volumen::reference
