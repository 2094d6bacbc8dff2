#include "ui/views/pick.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <utility>
#include <vector>

#include "ui/widgets/axes.h"
#include "viewer/scene/curve_edits.h"
#include "viewer/scene/modes.h"
#include "viewer/volume/gradients.h"

namespace volumen {

namespace {

// The part of the line inside box, clip box and clip planes, in mm along it (picture.md 6). Empty if first >=
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

// Extends the part by `beyond` voxels where the volume ends it and not the clip box.
Stretch visibleStretch(const Scene& scene, const VoxelGeometry& g, const SightLine& line, bool parallel,
                       double beyond = 0) {
  constexpr double far = 1e9;
  Stretch s{parallel ? -far : 0, far};
  const glm::dvec3 at = g.voxelFromPatient(line.origin), along = g.voxelFromPatientStep() * line.direction;
  const glm::dvec3 n(g.size), low = scene.clip.boxLow * n - 0.5, high = scene.clip.boxHigh * n - 0.5;
  for (int a = 0; a < 3; ++a) {
    s.cut(at[a], along[a], high[a] + (scene.clip.boxHigh[a] == 1 ? beyond : 0));
    s.cut(-at[a], -along[a], -low[a] + (scene.clip.boxLow[a] == 0 ? beyond : 0));
  }
  if (glm::any(glm::equal(scene.clip.boxLow, scene.clip.boxHigh))) s.last = s.first;
  for (const ClipPlane& plane : scene.clip.planes) {
    const glm::dvec3 normal = glm::normalize(plane.normal);
    s.cut(glm::dot(normal, line.origin), glm::dot(normal, line.direction), plane.offset);
  }
  return s;
}

// Interpolates at(i, j, k) trilinearly between the eight nearest voxels.
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

// Returns |g_p| of picture.md 3, value per mm.
double gradientLength(const Volume& volume, glm::dvec3 pVoxel) {
  const glm::dvec3 g =
      interpolated(volume.size(), pVoxel, [&](int i, int j, int k) { return sobelAt(volume, i, j, k); });
  return glm::length(volume.geometry().patientFromVoxelGradient() * g);
}

// Returns the factor of picture.md 4, linear between points. Of points with equal gradients the last one
// holds.
double gradientFactor(const std::vector<GradientOpacityPoint>& points, double gradient) {
  const auto above = std::upper_bound(points.begin(), points.end(), gradient,
                                      [](double g, const auto& p) { return g < p.gradient; });
  if (above == points.begin()) return points.front().factor;
  const GradientOpacityPoint& below = *(above - 1);
  if (above == points.end()) return below.factor;
  const double share = (gradient - below.gradient) / (above->gradient - below.gradient);
  return below.factor + share * (above->factor - below.factor);
}

// Returns f of picture.md 10.
double occupancyAt(const OccupancyField& field, glm::dvec3 pVoxel) {
  const glm::dvec3 x = pVoxel - glm::dvec3(field.box.low);
  const glm::i64vec3 size = field.size();
  if (glm::any(glm::lessThan(x, glm::dvec3(0))) || glm::any(glm::greaterThan(x, glm::dvec3(size - 1L))))
    return 0;
  return interpolated(field.size(), x, [&](int i, int j, int k) {
    return double(field.values[std::size_t((k * size.y + j) * size.x + i)]);
  });
}

// A line of sight through the scene; t is in mm along it.
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
    if (!shownSegments(scene).empty())
      withSegments_ = visibleStretch(scene, volume.geometry(), line, parallel, beyondVolume);
    else
      withSegments_ = seen_;
  }

  std::optional<Pick> surface() const;
  std::optional<Pick> extreme() const;
  std::optional<Pick> wholeLine() const;

 private:
  // Four samples catch a narrow band of the curve within the edge it lies on; the hit is refined.
  static constexpr double stepsPerVoxel = 4, finer = 64;
  static constexpr double beyondVolume = 1;  // voxels; no surface of a segment is farther out

  using Occupancies = std::vector<double>;  // of the scene's segments at a point
  // The optical depth of surfaces in one sampling step, and the first segment hit.
  struct Met {
    double depth = 0;
    std::optional<std::size_t> segment{};
  };
  // The point where an opacity is reached, and its segment; no segment if it lies in the volume.
  struct Place {
    double t;
    std::optional<std::size_t> segment{};
  };

  glm::dvec3 voxelAt(double t) const {
    return volume_.geometry().voxelFromPatient(line_.origin + t * line_.direction);
  }
  double valueAt(double t) const { return valueAtVoxel(volume_, voxelAt(t)); }
  Pick pickAt(double t) const { return {line_.origin + t * line_.direction, valueAt(t)}; }
  double extinctionAt(double t) const;
  Occupancies occupanciesAt(double t) const;
  Met metUpTo(double t, Occupancies& held) const;
  Place placeOf(double opacity, const std::vector<double>& depths) const;

  const Scene& scene_;
  const Volume& volume_;
  const SightLine& line_;
  const Stretch seen_;
  Stretch withSegments_;  // covers the volume and segment surfaces
  const double step_;
  bool anyFactor_ = false;
};

double Sight::extinctionAt(double t) const {
  if (t < seen_.first || t > seen_.last) return 0;
  const TransferFunction& curve = scene_.transferFunction;
  const glm::dvec3 x = voxelAt(t);
  double opacity = curveAt(curve, valueAtVoxel(volume_, x)).opacity;
  if (opacity > 0 && anyFactor_) opacity *= gradientFactor(curve.gradientOpacity, gradientLength(volume_, x));
  return extinctionPerMm(opacity, curve.unitDistance);
}

Sight::Occupancies Sight::occupanciesAt(double t) const {
  Occupancies held;
  const glm::dvec3 x = voxelAt(t);
  for (const SegmentSurface& segment : scene_.segments)
    held.push_back(segment.opacity > 0 ? occupancyAt(*segment.field, x) : 0);
  return held;
}

// Returns what is hit between the previous sampling step, with occupancies `held`, and t. Updates `held`.
// Only fine steps can tell which of several segments comes first.
Sight::Met Sight::metUpTo(double t, Occupancies& held) const {
  constexpr double mostOpaque = 1 - 1e-6, fineSteps = stepsPerVoxel * finer;    // per voxel
  constexpr double leftLater = 1e-3 * fineSteps, nextLater = 1e-6 * fineSteps;  // picture.md 10
  Met met;
  if (scene_.segments.empty()) return met;
  double first = 0;
  const Occupancies before = std::exchange(held, occupanciesAt(t));
  for (std::size_t n = 0; n < held.size(); ++n) {
    const bool isEntered = held[n] >= 0.5;
    if (isEntered == (before[n] >= 0.5)) continue;
    met.depth -= std::log1p(-std::min(scene_.segments[n].opacity, mostOpaque));
    const double at =
        (0.5 - before[n]) / (held[n] - before[n]) + (isEntered ? 0 : leftLater) + double(n) * nextLater;
    if (met.segment && at >= first) continue;
    met.segment = n;
    first = at;
  }
  return met;
}

std::optional<Pick> Sight::surface() const {
  constexpr double opaque = 20;  // optical depth that hides everything behind
  std::vector<double> depths;    // optical depth of each sampling step
  double whole = 0;
  Occupancies held = occupanciesAt(withSegments_.first);
  const double last = withSegments_.last;
  for (double t = withSegments_.first; t < last && whole < opaque; t += step_) {
    const double middle = t + step_ / 2, ofVolume = middle < last ? step_ * extinctionAt(middle) : 0;
    depths.push_back(ofVolume + metUpTo(std::min(t + step_, last), held).depth);
    whole += depths.back();
  }
  const double opacity = -std::expm1(-whole);
  if (opacity < 0.05) return {};
  const Place place = placeOf(opacity / 2, depths);
  Pick found = pickAt(place.t);
  found.segment = place.segment;
  found.softMm = std::max(0.0, placeOf(0.75 * opacity, depths).t - placeOf(0.25 * opacity, depths).t);
  return found;
}

// Finds the point from the optical depths of the sampling steps.
Sight::Place Sight::placeOf(double opacity, const std::vector<double>& depths) const {
  const Stretch line = withSegments_;
  double left = -std::log1p(-opacity);
  std::size_t n = 0;
  while (n + 1 < depths.size() && depths[n] < left) left -= depths[n++];
  // Refines with fine steps from the previous step, which may become visible behind its middle.
  Place place{line.first + (double(n) + 0.5) * step_};
  if (n > 0) left += depths[n - 1];
  const double from = std::max(line.first, place.t - 1.5 * step_),
               end = std::min(line.last, place.t + 2 * step_), fine = step_ / finer;
  Occupancies held = occupanciesAt(from);
  for (double t = from; t < end && left > 0; t += fine) {
    const double depth = fine * extinctionAt(t);
    left -= depth;
    if (depth > 0) place = {t};
    if (left <= 0) break;
    const Met met = metUpTo(std::min(t + fine, end), held);
    left -= met.depth;
    if (met.segment) place = {t + fine / 2, met.segment};
  }
  return place;
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
