#include "viewer/segment/segmentation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace volumen {
namespace {

/// A frame, by where it lies along the normal.
struct Plane {
  double along;
  std::size_t frame;
};

std::vector<Plane> planesOf(const Segmentation& s) {
  const glm::dvec3 normal = glm::cross(s.right, s.down);
  std::vector<Plane> planes;
  for (std::size_t n = 0; n < s.frames.size(); ++n)
    planes.push_back({glm::dot(s.frames[n].origin, normal), n});
  std::ranges::sort(planes, {}, &Plane::along);
  return planes;
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
  const std::vector<Plane> planes = planesOf(s);
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

SegmentPlaces::SegmentPlaces(const Segmentation& segmentation, std::size_t segment)
    : all_(segmentation), normal_(glm::cross(segmentation.right, segmentation.down)) {
  for (std::size_t n = 0; n < all_.frames.size(); ++n)
    if (all_.frames[n].segment == segment) planes_.push_back({glm::dot(all_.frames[n].origin, normal_), n});
  std::ranges::sort(planes_, {}, &Plane::along);
}

bool SegmentPlaces::holds(glm::dvec3 p) const {
  constexpr double touching = 1e-6;  // a place on the face between two planes belongs to one of them
  if (planes_.empty()) return false;
  const double along = glm::dot(p, normal_);
  auto plane = std::ranges::lower_bound(planes_, along, {}, &Plane::along);
  if (plane == planes_.end() || (plane != planes_.begin() && along - plane[-1].along < plane->along - along))
    --plane;
  if (std::abs(plane->along - along) > all_.thickness / 2 * (1 + touching)) return false;
  const glm::dvec3 from = p - all_.frames[plane->frame].origin;
  const double x = std::floor(glm::dot(from, all_.right) / all_.mm.x + 0.5),
               y = std::floor(glm::dot(from, all_.down) / all_.mm.y + 0.5);
  return x >= 0 && y >= 0 && x < all_.size.x && y < all_.size.y && all_.isSet(plane->frame, int(x), int(y));
}

std::vector<glm::dvec3> SegmentPlaces::corners() const {
  std::vector<glm::dvec3> corners;
  if (planes_.empty()) return corners;
  const double half = all_.thickness / 2;
  for (const auto& [plane, side] : {std::pair(planes_.front(), -half), std::pair(planes_.back(), half)})
    for (const double x : {-0.5, all_.size.x - 0.5})
      for (const double y : {-0.5, all_.size.y - 0.5})
        corners.push_back(all_.frames[plane.frame].origin + x * all_.mm.x * all_.right +
                          y * all_.mm.y * all_.down + side * normal_);
  return corners;
}

DenseLabels labelsOf(const Segmentation& s, std::size_t segment, const VoxelGeometry& grid) {
  DenseLabels map{grid, std::vector<std::uint8_t>(std::size_t(grid.voxelCount()))};
  const SegmentPlaces places(s, segment);
  const glm::dvec3 step = grid.patientFromVoxelStep[0];
  std::size_t n = 0;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j) {
      glm::dvec3 p = grid.patientFromVoxel(glm::dvec3(0, j, k));
      for (int i = 0; i < grid.size.x; ++i, ++n, p += step) map.labels[n] = places.holds(p);
    }
  return map;
}

}  // namespace volumen
