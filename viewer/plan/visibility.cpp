#include "viewer/plan/visibility.h"

#include <algorithm>
#include <cmath>

namespace volumen {

namespace {

// A maximal run of values on which the opacity is above 0, as an open or half-open interval: widened by
// rounding anyway.
struct Span {
  double low, high;
};

std::vector<Span> visibleSpans(const TransferFunction& curve) {
  const auto& points = curve.points;
  std::vector<Span> spans;
  const auto add = [&](double low, double high) {
    if (!spans.empty() && low <= spans.back().high)
      spans.back().high = high;
    else
      spans.push_back({low, high});
  };
  if (points.front().opacity > 0) add(-HUGE_VAL, points.front().value);
  for (std::size_t n = 0; n + 1 < points.size(); ++n)
    if (points[n].opacity > 0 || points[n + 1].opacity > 0) add(points[n].value, points[n + 1].value);
  if (points.back().opacity > 0) add(points.back().value, HUGE_VAL);
  return spans;
}

}  // namespace

double largestOpacity(const TransferFunction& curve, double low, double high) {
  const auto& points = curve.points;
  const auto at = [&](double v) {
    std::size_t n = 0;
    while (n < points.size() && points[n].value <= v) ++n;
    if (n == 0) return points.front().opacity;
    if (n == points.size()) return points.back().opacity;
    const CurvePoint &a = points[n - 1], &b = points[n];
    return a.opacity + (v - a.value) / (double(b.value) - a.value) * (b.opacity - a.opacity);
  };
  double most = std::max(at(low), at(high));
  for (const CurvePoint& p : points)
    if (p.value >= low && p.value <= high) most = std::max(most, p.opacity);
  return most;
}

std::vector<std::uint8_t> visibleBlocks(const TransferFunction& curve, const BrickRanges& bricks) {
  const std::vector<Span> spans = visibleSpans(curve);
  std::vector<std::uint8_t> visible(bricks.low.size());
  for (std::size_t n = 0; n < visible.size(); ++n) {
    const double low = bricks.low[n], high = bricks.high[n];
    const double rounding = 4e-7 * std::max({std::abs(low), std::abs(high), 1e-30});
    visible[n] = std::any_of(spans.begin(), spans.end(), [&](const Span& s) {
      return high + rounding >= s.low && low - rounding <= s.high;
    });
  }
  return visible;
}

}  // namespace volumen
