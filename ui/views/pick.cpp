#include "ui/views/pick.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "ui/widgets/axes.h"
#include "viewer/scene/curve_edits.h"
#include "viewer/scene/modes.h"
#include "viewer/volume/gradients.h"

namespace volumen {

namespace {

// The part of the line inside box, clip box and clip planes, in mm along it (picture.md 6). Empty: first >=
// last.
struct Stretch {
  double first, last;

  // Keeps the part with at + t * along <= limit.
  void cut(double at, double along, double limit) {
    if (along == 0) {
      if (at > limit) last = first;
    } else if (along > 0) {
      last = std::min(last, (limit - at) / along);
    } else {
      first = std::max(first, (limit - at) / along);
    }
  }
};

Stretch visibleStretch(const Scene& scene, const VoxelGeometry& g, const SightLine& line, bool parallel) {
  constexpr double far = 1e9;
  Stretch s{parallel ? -far : 0, far};
  const glm::dvec3 at = g.voxelFromPatient(line.origin), along = g.voxelFromPatientStep() * line.direction;
  const glm::dvec3 n(g.size), low = scene.clip.boxLow * n - 0.5, high = scene.clip.boxHigh * n - 0.5;
  for (int a = 0; a < 3; ++a) {
    s.cut(at[a], along[a], high[a]);
    s.cut(-at[a], -along[a], -low[a]);
  }
  for (const ClipPlane& plane : scene.clip.planes) {
    const glm::dvec3 normal = glm::normalize(plane.normal);
    s.cut(glm::dot(normal, line.origin), glm::dot(normal, line.direction), plane.offset);
  }
  return s;
}

// Trilinear between the eight nearest voxels, of at(i, j, k).
template <class At>
auto interpolated(glm::ivec3 size, glm::dvec3 pVoxel, const At& at) {
  const glm::dvec3 x = glm::clamp(pVoxel, glm::dvec3(0), glm::dvec3(size - 1));
  const glm::ivec3 a(x), b = glm::min(a + 1, size - 1);
  const glm::dvec3 f = x - glm::dvec3(a);
  const auto between = [](auto from, auto to, double share) { return from + share * (to - from); };
  const auto row = [&](int j, int k) { return between(at(a.x, j, k), at(b.x, j, k), f.x); };
  const auto slice = [&](int k) { return between(row(a.y, k), row(b.y, k), f.y); };
  return between(slice(a.z), slice(b.z), f.z);
}

// |g_p| of picture.md 3, value per mm.
double gradientLength(const Volume& volume, glm::dvec3 pVoxel) {
  const glm::dvec3 g =
      interpolated(volume.size(), pVoxel, [&](int i, int j, int k) { return sobelAt(volume, i, j, k); });
  return glm::length(volume.geometry().patientFromVoxelGradient() * g);
}

// The factor of picture.md 4, linear between points, the last of equal ones holding at their gradient.
double gradientFactor(const std::vector<GradientOpacityPoint>& points, double gradient) {
  const auto above = std::upper_bound(points.begin(), points.end(), gradient,
                                      [](double g, const auto& p) { return g < p.gradient; });
  if (above == points.begin()) return points.front().factor;
  const GradientOpacityPoint& below = *(above - 1);
  if (above == points.end()) return below.factor;
  const double share = (gradient - below.gradient) / (above->gradient - below.gradient);
  return below.factor + share * (above->factor - below.factor);
}

// A line of sight through the scene; t in mm along it.
class Sight {
 public:
  Sight(const Scene& scene, const Volume& volume, const SightLine& line, bool parallel)
      : scene_(scene),
        volume_(volume),
        line_(line),
        seen_(visibleStretch(scene, volume.geometry(), line, parallel)),
        step_(1 / (stepsPerVoxel * glm::length(volume.geometry().voxelFromPatientStep() * line.direction))) {
    for (const GradientOpacityPoint& p : scene.transferFunction.gradientOpacity)
      anyFactor_ = anyFactor_ || p.factor != 1;
  }

  std::optional<Pick> surface() const;
  std::optional<Pick> extreme() const;
  std::optional<Pick> wholeLine() const;

 private:
  // Four, so that a curve's narrow band is met within the edge that it lies on; finer where it is found.
  static constexpr double stepsPerVoxel = 4, finer = 64;

  glm::dvec3 voxelAt(double t) const {
    return volume_.geometry().voxelFromPatient(line_.origin + t * line_.direction);
  }
  double valueAt(double t) const { return valueAtVoxel(volume_, voxelAt(t)); }
  Pick pickAt(double t) const { return {line_.origin + t * line_.direction, valueAt(t)}; }
  double extinctionAt(double t) const;
  double placeOf(double opacity, const std::vector<double>& depths) const;

  const Scene& scene_;
  const Volume& volume_;
  const SightLine& line_;
  const Stretch seen_;
  const double step_;
  bool anyFactor_ = false;
};

double Sight::extinctionAt(double t) const {
  const TransferFunction& curve = scene_.transferFunction;
  const glm::dvec3 x = voxelAt(t);
  double opacity = curveAt(curve, valueAtVoxel(volume_, x)).opacity;
  if (opacity > 0 && anyFactor_) opacity *= gradientFactor(curve.gradientOpacity, gradientLength(volume_, x));
  return extinctionPerMm(opacity, curve.unitDistance);
}

std::optional<Pick> Sight::surface() const {
  constexpr double opaque = 20;  // optical depth behind which nothing is seen
  std::vector<double> depths;    // optical, of each step
  double whole = 0;
  for (double t = seen_.first + step_ / 2; t < seen_.last && whole < opaque; t += step_) {
    depths.push_back(step_ * extinctionAt(t));
    whole += depths.back();
  }
  const double opacity = -std::expm1(-whole);
  if (opacity < 0.05) return {};
  Pick found = pickAt(placeOf(opacity / 2, depths));
  found.softMm = std::max(0.0, placeOf(0.75 * opacity, depths) - placeOf(0.25 * opacity, depths));
  return found;
}

// Where that much opacity is reached, by the optical depths of the steps.
double Sight::placeOf(double opacity, const std::vector<double>& depths) const {
  double left = -std::log1p(-opacity);
  std::size_t n = 0;
  while (n + 1 < depths.size() && depths[n] < left) left -= depths[n++];
  // Again in fine steps, from the step before, which may begin to be visible behind its middle.
  double at = seen_.first + (double(n) + 0.5) * step_;
  if (n > 0) left += depths[n - 1];
  const double end = std::min(seen_.last, at + 2 * step_);
  for (double t = std::max(seen_.first, at - 1.5 * step_); t < end && left > 0; t += step_ / finer) {
    const double depth = step_ / finer * extinctionAt(t);
    left -= depth;
    if (depth > 0) at = t;
  }
  return at;
}

std::optional<Pick> Sight::extreme() const {
  const double sign = rowOf(scene_.mode).shows == Shows::largest ? 1 : -1;
  std::optional<double> at;
  double most = 0;
  const auto look = [&](double first, double last, double step) {
    for (double t = first + step / 2; t < last; t += step) {
      const double value = sign * valueAt(t);
      if (at && value <= most) continue;
      most = value;
      at = t;
    }
  };
  look(seen_.first, seen_.last, step_);
  if (!at) return {};
  look(std::max(seen_.first, *at - step_), std::min(seen_.last, *at + step_), step_ / finer);
  return pickAt(*at);
}

std::optional<Pick> Sight::wholeLine() const {
  const auto projection = rowOf(scene_.mode).project();
  double length = 0;
  for (double t = seen_.first + step_ / 2; t < seen_.last; t += step_, length += step_) {
    const double value = valueAt(t);
    projection->add({{value}, value, value, step_});
  }
  if (length == 0) return {};
  return Pick{{}, projection->value(length)};
}

}  // namespace

double valueAtVoxel(const Volume& volume, glm::dvec3 pVoxel) {
  return interpolated(volume.size(), pVoxel,
                      [&](int i, int j, int k) { return double(volume.value(i, j, k)); });
}

std::optional<Pick> pick(const Scene& scene, const Volume& volume, const SightLine& line, bool parallel) {
  const Sight sight(scene, volume, line, parallel);
  const Shows shows = rowOf(scene.mode).shows;
  if (shows == Shows::surface) return sight.surface();
  return shows == Shows::wholeLine ? sight.wholeLine() : sight.extreme();
}

}  // namespace volumen
