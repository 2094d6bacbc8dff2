#include "tests/unit/slice/slow_slice.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

namespace volumen::tests {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double clampedVoxel(const Volume& v, int i, int j, int k) {
  const glm::ivec3 last = v.size() - 1;
  return v.value(std::clamp(i, 0, last.x), std::clamp(j, 0, last.y), std::clamp(k, 0, last.z));
}

// Returns the weight of the voxel at `distance` from a point along an axis.
double weightOf(Interpolation how, double distance) {
  const double d = std::abs(distance);
  if (how == Interpolation::linear) return std::max(0.0, 1 - d);
  if (d < 1) return 1 - 2.5 * d * d + 1.5 * d * d * d;  // Catmull-Rom
  return d < 2 ? 2 - 4 * d + 2.5 * d * d - 0.5 * d * d * d : 0;
}

double valueAt(const Volume& volume, Interpolation how, glm::dvec3 x) {
  if (how == Interpolation::nearest) {
    const glm::dvec3 voxel = glm::floor(x + 0.5);
    return clampedVoxel(volume, int(voxel.x), int(voxel.y), int(voxel.z));
  }
  const glm::ivec3 low(glm::floor(x));
  double sum = 0;
  for (int k = low.z - 1; k <= low.z + 2; ++k)
    for (int j = low.y - 1; j <= low.y + 2; ++j)
      for (int i = low.x - 1; i <= low.x + 2; ++i)
        sum += weightOf(how, x.x - i) * weightOf(how, x.y - j) * weightOf(how, x.z - k) *
               clampedVoxel(volume, i, j, k);
  return sum;
}

class Slow {
 public:
  Slow(const Volume& volume, const SlicePlane& plane) : volume_(volume), plane_(plane) {
    const VoxelGeometry& g = volume.geometry();
    perMm_ = glm::inverse(g.patientFromVoxelStep);
    const glm::dvec3 s = g.spacing();
    const double h = 1 / glm::length(perMm_ * normal());
    deep_ = std::max(1, int(std::ceil(2 * plane.slabMm / h - 1e-6)));
    if (plane.average)
      perPixel_ = std::max(1, int(std::ceil(plane.mmPerPixel / std::min({s.x, s.y, s.z}) - 1e-6)));
  }

  double pixel(int px, int py, bool& doubtful) const {
    double sum = 0;
    int counted = 0;
    for (int b = 0; b < perPixel_; ++b)
      for (int a = 0; a < perPixel_; ++a)
        if (const auto value = slab(px + (a + 0.5) / perPixel_, py + (b + 0.5) / perPixel_, doubtful))
          sum += *value, ++counted;
    return counted ? sum / counted : nan;
  }

 private:
  glm::dvec3 normal() const { return glm::cross(plane_.right, plane_.down); }

  std::optional<double> slab(double px, double py, bool& doubtful) const {
    std::vector<double> all;
    for (int k = 0; k < deep_; ++k) {
      const double t = plane_.slabMm;
      const glm::dvec3 p = plane_.centre + (px - plane_.size.x / 2.0) * plane_.mmPerPixel * plane_.right +
                           (py - plane_.size.y / 2.0) * plane_.mmPerPixel * plane_.down +
                           (-t / 2 + (k + 0.5) * t / deep_) * normal();
      const glm::dvec3 x = perMm_ * (p - volume_.geometry().origin);
      bool inside = true;
      for (int a = 0; a < 3; ++a) {
        const double beyond = std::min(x[a] + 0.5, volume_.size()[a] - 0.5 - x[a]);
        inside = inside && beyond >= 0;
        const bool middle = plane_.interpolation == Interpolation::nearest &&
                            std::abs(x[a] + 0.5 - std::round(x[a] + 0.5)) < 1e-6;
        doubtful = doubtful || std::abs(beyond) < 1e-6 || middle;
      }
      if (inside) all.push_back(valueAt(volume_, plane_.interpolation, x));
    }
    if (all.empty()) return {};
    if (plane_.slabMode == SlabMode::max) return *std::max_element(all.begin(), all.end());
    if (plane_.slabMode == SlabMode::min) return *std::min_element(all.begin(), all.end());
    double sum = 0;
    for (double v : all) sum += v;
    return sum / double(all.size());
  }

  const Volume& volume_;
  SlicePlane plane_;
  glm::dmat3 perMm_;
  int deep_ = 1, perPixel_ = 1;
};

}  // namespace

SlowSlice slowSlice(const Volume& volume, const SlicePlane& plane) {
  const Slow slow(volume, plane);
  SlowSlice out;
  for (int y = 0; y < plane.size.y; ++y)
    for (int x = 0; x < plane.size.x; ++x) {
      bool doubtful = false;
      out.values.push_back(slow.pixel(x, y, doubtful));
      out.doubtful.push_back(doubtful);
    }
  return out;
}

}  // namespace volumen::tests
