#include "viewer/reference/ray.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace volumen::reference {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Keeps the part where start + t slope <= limit. A ray that drifts by less than `rounding` over the volume's
// length counts as parallel to the boundary. The boundary counts as inside to within `rounding`, so that
// rounding errors do not decide.
void cut(Interval& interval, double start, double slope, double limit, double lengthMm, double rounding) {
  if (std::abs(slope) * lengthMm > rounding) {
    const double t = (limit - start) / slope;
    slope > 0 ? interval.t1 = std::min(interval.t1, t) : interval.t0 = std::max(interval.t0, t);
  } else if (start > limit + rounding) {
    interval.t1 = -infinity;
  }
}

}  // namespace

RayMaker::RayMaker(const Camera& camera, const VoxelGeometry& geometry, glm::ivec2 size)
    : axes_(cameraAxes(camera)),
      target_(camera.target.value_or(geometry.centre())),
      size_(size),
      perspective_(camera.projection == Projection::perspective),
      distanceMm_(camera.distance),
      heightMm_(perspective_ ? 2 * camera.distance * std::tan(glm::radians(camera.fov) / 2) : camera.height) {
}

Ray RayMaker::through(int px, int py) const {
  const double a = ((px + 0.5) / size_.x - 0.5) * heightMm_ * size_.x / size_.y;
  const double b = (0.5 - (py + 0.5) / size_.y) * heightMm_;
  const glm::dvec3 sideways = a * axes_.right + b * axes_.up;
  if (!perspective_) return {target_ + sideways, axes_.direction, -infinity};
  const glm::dvec3 fromEye = distanceMm_ * axes_.direction + sideways;
  return {target_ + sideways, glm::normalize(fromEye), -glm::length(fromEye)};
}

namespace {

// The sides of the clip box that cut along each axis.
struct Sides {
  glm::bvec3 low{true}, high{true};
};

Interval intervalWithin(const Ray& ray, const VoxelGeometry& geometry, const Clip& clip, const Sides& sides) {
  Interval interval{ray.nearMm, infinity};
  const glm::dvec3 start = geometry.voxelFromPatient(ray.origin);
  const glm::dvec3 slope = geometry.voxelFromPatientStep() * ray.direction;
  constexpr double roundingVoxels = 1e-9;
  const glm::dvec3 spacing = geometry.spacing();
  const double roundingMm = roundingVoxels * std::min({spacing.x, spacing.y, spacing.z});
  const double lengthMm = glm::dot(spacing, glm::dvec3(geometry.size));
  for (int a = 0; a < 3; ++a) {
    if (sides.high[a])
      cut(interval, start[a], slope[a], clip.boxHigh[a] * geometry.size[a] - 0.5, lengthMm, roundingVoxels);
    if (sides.low[a])
      cut(interval, -start[a], -slope[a], 0.5 - clip.boxLow[a] * geometry.size[a], lengthMm, roundingVoxels);
  }
  for (const ClipPlane& plane : clip.planes) {
    const glm::dvec3 normal = glm::normalize(plane.normal);
    cut(interval, glm::dot(normal, ray.origin), glm::dot(normal, ray.direction), plane.offset, lengthMm,
        roundingMm);
  }
  return interval;
}

}  // namespace

Interval visibleInterval(const Ray& ray, const VoxelGeometry& geometry, const Clip& clip) {
  return intervalWithin(ray, geometry, clip, {});
}

Interval surfaceInterval(const Ray& ray, const VoxelGeometry& geometry, const Clip& clip) {
  if (glm::any(glm::equal(clip.boxLow, clip.boxHigh))) return {0, 0};
  return intervalWithin(
      ray, geometry, clip,
      {glm::greaterThan(clip.boxLow, glm::dvec3(0)), glm::lessThan(clip.boxHigh, glm::dvec3(1))});
}

}  // namespace volumen::reference
