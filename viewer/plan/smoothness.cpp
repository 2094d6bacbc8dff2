#include "viewer/plan/smoothness.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "viewer/plan/facts.h"
#include "viewer/volume/gradient_bounds.h"

namespace volumen {

namespace {

// Returns the largest slope in cells that hold any value between the two, value per voxel.
double largestSlope(const VolumeFacts& facts, double low, double high) {
  const auto entry = [&](double value) {
    return facts.gradientBounds.begin() + std::ptrdiff_t(gradientBoundEntry(value, facts.range));
  };
  return *std::max_element(entry(low), entry(high) + 1);
}

double extinctionAt(const CurvePoint& p, double unitMm) {
  return p.opacity < 1 ? -std::log1p(-p.opacity) / unitMm : std::numeric_limits<double>::infinity();
}

// Returns the bounds between two curve points; before the first and after the last nothing changes.
Steepness between(const CurvePoint& a, const CurvePoint& b, double unitMm, const VolumeFacts& facts) {
  const double most = std::max(a.opacity, b.opacity);
  Steepness s;
  if (most <= 0 || b.value < facts.range.low || a.value > facts.range.high) return s;
  s.perMm = std::max(extinctionAt(a, unitMm), extinctionAt(b, unitMm));
  if (a.opacity == b.opacity && a.colour == b.colour) return s;
  const double width = double(b.value) - a.value;
  if (!(width > 0) || most >= 1) {
    s.change = std::numeric_limits<double>::infinity();
    return s;
  }
  const glm::dvec3 colours = glm::abs(b.colour - a.colour);
  // The slope of -ln(1 - opacity) is largest at the largest opacity.
  const double rise = std::abs(b.opacity - a.opacity) / (1 - most) / unitMm +
                      s.perMm * std::max({colours.r, colours.g, colours.b});
  s.change = rise / width *
             largestSlope(facts, std::max<double>(a.value, facts.range.low),
                          std::min<double>(b.value, facts.range.high));
  return s;
}

}  // namespace

Steepness steepnessOf(const TransferFunction& curve, const VolumeFacts& facts) {
  Steepness all;
  const auto& points = curve.points;
  if (points.empty()) return all;
  const auto takeIn = [&](const Steepness& s) {
    all.perMm = std::max(all.perMm, s.perMm);
    all.change = std::max(all.change, s.change);
  };
  if (facts.range.low <= points.front().value) all.perMm = extinctionAt(points.front(), curve.unitDistance);
  if (facts.range.high >= points.back().value)
    all.perMm = std::max(all.perMm, extinctionAt(points.back(), curve.unitDistance));
  for (std::size_t n = 0; n + 1 < points.size(); ++n)
    takeIn(between(points[n], points[n + 1], curve.unitDistance, facts));
  return all;
}

int turnsOf(const TransferFunction& curve) {
  const auto turns = [&](const auto& valueOf) {
    int count = 0;
    double before = 0;  // last change that is not 0
    for (std::size_t n = 0; n + 1 < curve.points.size(); ++n) {
      const double change = valueOf(curve.points[n + 1]) - valueOf(curve.points[n]);
      count += change * before < 0;
      if (change != 0) before = change;
    }
    return count;
  };
  int most = turns([](const CurvePoint& p) { return p.opacity; });
  for (int c = 0; c < 3; ++c) most = std::max(most, turns([c](const CurvePoint& p) { return p.colour[c]; }));
  return most;
}

}  // namespace volumen
