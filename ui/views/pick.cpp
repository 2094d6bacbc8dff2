#include "ui/views/pick.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "ui/widgets/axes.h"
#include "ui/widgets/curve_edits.h"

namespace volumen {

namespace {

// The part of the line inside box, clip box and clip planes, in mm along it (SCENE 6). Empty: first >= last.
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

}  // namespace

double valueAtVoxel(const Volume& volume, glm::dvec3 pVoxel) {
  const glm::dvec3 last = glm::dvec3(volume.size() - 1);
  const glm::dvec3 x = glm::clamp(pVoxel, glm::dvec3(0), last);
  const glm::ivec3 a(x), b = glm::min(a + 1, volume.size() - 1);
  const glm::dvec3 f = x - glm::dvec3(a);
  const auto row = [&](int j, int k) {
    const double from = volume.value(a.x, j, k);
    return from + f.x * (volume.value(b.x, j, k) - from);
  };
  const auto slice = [&](int k) {
    const double from = row(a.y, k);
    return from + f.y * (row(b.y, k) - from);
  };
  const double from = slice(a.z);
  return from + f.z * (slice(b.z) - from);
}

std::optional<Pick> pick(const Scene& scene, const Volume& volume, const SightLine& line, bool parallel) {
  const VoxelGeometry& g = volume.geometry();
  const Stretch stretch = visibleStretch(scene, g, line, parallel);
  const double step = 0.5 / glm::length(g.voxelFromPatientStep() * line.direction);
  const auto valueAt = [&](double t) {
    return valueAtVoxel(volume, g.voxelFromPatient(line.origin + t * line.direction));
  };
  double transmittance = 1, weighted = 0, largest = -std::numeric_limits<double>::infinity(), largestAt = 0;
  for (double t = stretch.first + step / 2; t < stretch.last && transmittance > 0.02; t += step) {
    const double value = valueAt(t);
    if (scene.mode != Mode::composite) {
      if (value > largest) largestAt = t;
      largest = std::max(largest, value);
      continue;
    }
    const double opacity = curveAt(scene.transferFunction, value).opacity;
    const double stopped = -std::expm1(-extinctionPerMm(opacity, scene.transferFunction.unitDistance) * step);
    weighted += t * transmittance * stopped;
    transmittance *= 1 - stopped;
  }
  double depth = largestAt;
  if (scene.mode == Mode::composite) {
    if (transmittance > 0.95) return {};
    depth = weighted / (1 - transmittance);
  } else if (!std::isfinite(largest)) {
    return {};
  }
  return Pick{line.origin + depth * line.direction, valueAt(depth)};
}

}  // namespace volumen
