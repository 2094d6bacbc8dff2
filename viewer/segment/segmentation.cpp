#include "viewer/segment/segmentation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace volumen {
namespace {

/// A frame of one segment, by where it lies along the normal.
struct Plane {
  double along;
  std::size_t frame;
};

std::vector<Plane> planesOf(const Segmentation& s, std::optional<std::size_t> segment) {
  const glm::dvec3 normal = glm::cross(s.right, s.down);
  std::vector<Plane> planes;
  for (std::size_t n = 0; n < s.frames.size(); ++n)
    if (!segment || s.frames[n].segment == *segment)
      planes.push_back({glm::dot(s.frames[n].origin, normal), n});
  std::ranges::sort(planes, {}, &Plane::along);
  return planes;
}

/// The nearest of them; there is at least one.
const Plane& nearest(const std::vector<Plane>& planes, double along) {
  const auto next = std::ranges::lower_bound(planes, along, {}, &Plane::along);
  if (next == planes.begin()) return *next;
  const auto before = next - 1;
  return next == planes.end() || along - before->along < next->along - along ? *before : *next;
}

}  // namespace

std::int64_t pixelsOf(const Segmentation& s, std::size_t segment) {
  std::int64_t count = 0;
  for (std::size_t n = 0; n < s.frames.size(); ++n)
    for (int y = 0; y < s.size.y && s.frames[n].segment == segment; ++y)
      for (int x = 0; x < s.size.x; ++x) count += s.isSet(n, x, y);
  return count;
}

Result<VoxelGeometry> gridOf(const Segmentation& s) {
  constexpr double same = 1e-3, off = 0.05;  // mm, and part of a step
  constexpr double mostVoxels = 2147483647;
  const std::vector<Plane> planes = planesOf(s, {});
  if (planes.empty()) return Error{"the segmentation has no frames"};
  double step = HUGE_VAL;
  for (std::size_t n = 1; n < planes.size(); ++n)
    if (const double gap = planes[n].along - planes[n - 1].along; gap > same) step = std::min(step, gap);
  if (!std::isfinite(step)) step = s.thickness;
  const Plane& first = planes.front();
  const double last = std::round((planes.back().along - first.along) / step);
  if (!(double(s.size.x) * s.size.y * (last + 1) <= mostVoxels))
    return Error{"the grid of the segmentation has 2^31 voxels or more"};
  const glm::dvec3 normal = glm::cross(s.right, s.down), origin = s.frames[first.frame].origin;
  for (const Plane& plane : planes) {
    const double k = (plane.along - first.along) / step;
    const glm::dvec3 expected = origin + std::round(k) * step * normal;
    if (std::abs(k - std::round(k)) > off ||
        glm::distance(s.frames[plane.frame].origin, expected) > off * (step + std::max(s.mm.x, s.mm.y)))
      return Error{"the frames of the segmentation do not lie on an even grid"};
  }
  VoxelGeometry grid;
  grid.size = {s.size.x, s.size.y, int(last) + 1};
  grid.patientFromVoxelStep = {s.right * s.mm.x, s.down * s.mm.y, normal * step};
  grid.origin = origin;
  return grid;
}

LabelMap labelMapOf(const Segmentation& s, std::size_t segment, const VoxelGeometry& grid) {
  LabelMap map{grid, std::vector<std::uint8_t>(std::size_t(grid.voxelCount()))};
  const std::vector<Plane> planes = planesOf(s, segment);
  if (planes.empty()) return map;
  constexpr double touching = 1e-6;  // a voxel on the face between two planes belongs to one of them
  const glm::dvec3 normal = glm::cross(s.right, s.down), step = grid.patientFromVoxelStep[0];
  const double reach = s.thickness / 2 * (1 + touching);
  std::size_t n = 0;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j) {
      glm::dvec3 p = grid.patientFromVoxel(glm::dvec3(0, j, k));
      for (int i = 0; i < grid.size.x; ++i, ++n, p += step) {
        const double along = glm::dot(p, normal);
        const Plane& plane = nearest(planes, along);
        if (std::abs(plane.along - along) > reach) continue;
        const glm::dvec3 from = p - s.frames[plane.frame].origin;
        const double x = std::floor(glm::dot(from, s.right) / s.mm.x + 0.5),
                     y = std::floor(glm::dot(from, s.down) / s.mm.y + 0.5);
        const bool inside = x >= 0 && y >= 0 && x < s.size.x && y < s.size.y;
        map.labels[n] = inside && s.isSet(plane.frame, int(x), int(y));
      }
    }
  return map;
}

}  // namespace volumen
