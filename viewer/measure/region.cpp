#include "viewer/measure/region.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "viewer/measure/outline.h"

namespace volumen {

namespace {

using glm::dvec3;

int axisClosestTo(dvec3 normal, const VoxelGeometry& geometry) {
  const auto cosine = [&](int a) {
    return std::abs(glm::dot(normal, glm::normalize(geometry.patientFromVoxelStep[a])));
  };
  int closest = 0;
  for (int a : {1, 2})
    if (cosine(a) > cosine(closest)) closest = a;
  return closest;
}

// A range of whole voxels along each axis, from `first` to `last`, inside the volume.
struct Reach {
  int first[3], last[3];
};

// Returns the box of voxels that a region can contain.
Reach reachOf(const Outline& outline, const ShapePlane& plane, double thickness,
              const VoxelGeometry& geometry) {
  const double level = glm::dot(plane.normal(), plane.centre);
  dvec3 low(1e300), high(-1e300);
  for (int corner = 0; corner < 8; ++corner) {
    const dvec3 p = (corner & 1 ? outline.high.x : outline.low.x) * plane.right +
                    (corner & 2 ? outline.high.y : outline.low.y) * plane.down +
                    (level + (corner & 4 ? thickness : -thickness)) * plane.normal();
    const dvec3 x = geometry.voxelFromPatient(p);
    low = glm::min(low, x);
    high = glm::max(high, x);
  }
  Reach reach;
  for (int a = 0; a < 3; ++a) {
    const double most = geometry.size[a] - 1;
    reach.first[a] = int(std::clamp(std::floor(low[a]), 0.0, most));
    reach.last[a] = int(std::clamp(std::ceil(high[a]), 0.0, most));
  }
  return reach;
}

// Sums differences from the first value, so that equal values have no deviation at all.
class Sums {
 public:
  void add(double value) {
    if (all_.n++ == 0) first_ = all_.min = all_.max = value;
    all_.min = std::min(all_.min, value);
    all_.max = std::max(all_.max, value);
    const double d = value - first_;
    sum_ += d;
    squares_ += d * d;
  }
  std::optional<ValueStatistics> statistics() const {
    if (all_.n == 0) return {};
    ValueStatistics s = all_;
    const double mean = sum_ / double(s.n);
    s.mean = first_ + mean;
    s.sd = std::sqrt(std::max(0.0, squares_ / double(s.n) - mean * mean));
    return s;
  }

 private:
  ValueStatistics all_;
  double first_ = 0, sum_ = 0, squares_ = 0;
};

}  // namespace

void forEachVoxelOf(const Shape& region, const Volume& volume,
                    const std::function<void(glm::ivec3 voxel, double value)>& visit) {
  const VoxelGeometry& geometry = volume.geometry();
  const ShapePlane& plane = *region.plane;
  const Outline outline = outlineOf(region);
  const dvec3 normal = plane.normal();
  const int along = axisClosestTo(normal, geometry), u = (along + 1) % 3, v = (along + 2) % 3;
  const double step = glm::dot(normal, geometry.patientFromVoxelStep[along]);
  const Reach reach = reachOf(outline, plane, std::abs(step), geometry);
  const std::optional<ValueRange>& padding = volume.attributes().padding;
  glm::ivec3 x;
  for (x[v] = reach.first[v]; x[v] <= reach.last[v]; ++x[v])
    for (x[u] = reach.first[u]; x[u] <= reach.last[u]; ++x[u]) {
      x[along] = 0;
      const double q = glm::dot(normal, geometry.patientFromVoxel(dvec3(x)) - plane.centre) / step;
      const double nearest = std::ceil(-0.5 - q - 1e-6);
      if (!(nearest >= 0 && nearest < geometry.size[along])) continue;
      x[along] = int(nearest);
      if (!contains(outline, onPlane(plane, geometry.patientFromVoxel(dvec3(x))))) continue;
      const double value = double(volume.value(x.x, x.y, x.z));
      if (!isPadding(padding, value)) visit(x, value);
    }
}

std::optional<ValueStatistics> regionValues(const Shape& region, const Volume& volume) {
  Sums sums;
  forEachVoxelOf(region, volume, [&](glm::ivec3, double value) { sums.add(value); });
  return sums.statistics();
}

}  // namespace volumen
