#include "viewer/scene/visible_range.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace volumen {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float largest = std::numeric_limits<float>::max();

float above(float value) { return std::nextafter(value, infinity); }
float below(float value) { return std::nextafter(value, -infinity); }

// Return the smallest float32 >= value and the largest <= value, clamped to finite ones.
float ceilFloat(double value) {
  const auto f = float(std::clamp(value, -double(largest), double(largest)));
  return double(f) < value && f < largest ? above(f) : f;
}
float floorFloat(double value) {
  const auto f = float(std::clamp(value, -double(largest), double(largest)));
  return double(f) > value && f > -largest ? below(f) : f;
}

// Returns the curve just below a value (picture.md 4: the first of equal points is the limit from below).
CurvePoint limitFromBelow(const std::vector<CurvePoint>& points, float value) {
  const auto b = std::find_if(points.begin(), points.end(), [&](const auto& p) { return p.value >= value; });
  if (b == points.begin()) return {value, b->colour, b->opacity};
  const CurvePoint& a = *(b - 1);
  if (b == points.end()) return {value, a.colour, a.opacity};
  const double f = (double(value) - double(a.value)) / (double(b->value) - double(a.value));
  return {value, a.colour + f * (b->colour - a.colour), a.opacity + f * (b->opacity - a.opacity)};
}

// Returns the curve at a value (the last of equal points holds there).
CurvePoint at(const std::vector<CurvePoint>& points, float value) {
  for (auto p = points.rbegin(); p != points.rend(); ++p)
    if (p->value == value) return *p;
  return limitFromBelow(points, value);
}

}  // namespace

TransferFunction restrictedTo(const TransferFunction& curve, ValueRange range) {
  const float low = ceilFloat(range.low), high = floorFloat(range.high);
  TransferFunction out{curve.unitDistance, {}, curve.gradientOpacity};
  const auto add = [&](CurvePoint p, double opacity) {
    p.opacity = opacity;
    out.points.push_back(p);
  };
  if (!(low <= high)) {
    add(curve.points.front(), 0);
    return out;
  }
  const CurvePoint first = at(curve.points, low);
  if (range.low >= -double(largest)) add(first, 0);
  add(first, first.opacity);
  for (const CurvePoint& p : curve.points)
    if (p.value > low && p.value <= high) out.points.push_back(p);
  if (range.high <= double(largest) && high < largest) {
    const CurvePoint end = limitFromBelow(curve.points, above(high));
    add(end, end.opacity);
    add(end, 0);
  }
  return out;
}

std::vector<ValueRange> visibleSpans(const TransferFunction& curve) {
  const std::vector<CurvePoint>& points = curve.points;
  std::vector<ValueRange> spans;
  // Pieces come in ascending order without gaps between their float32 values, so a visible piece next to the
  // last span extends it.
  const auto add = [&](float low, float high, bool visible) {
    if (!visible || low > high) return;
    if (!spans.empty() && above(float(spans.back().high)) == low)
      spans.back().high = double(high);
    else
      spans.push_back({double(low), double(high)});
  };
  add(-infinity, below(points.front().value), points.front().opacity > 0);
  for (std::size_t n = 0; n < points.size(); ++n) {
    const CurvePoint& p = points[n];
    const bool last = n + 1 == points.size();
    if (!last && points[n + 1].value == p.value) continue;
    add(p.value, p.value, p.opacity > 0);
    const bool visible = p.opacity > 0 || (!last && points[n + 1].opacity > 0);
    add(above(p.value), last ? infinity : below(points[n + 1].value), visible);
  }
  return spans;
}

}  // namespace volumen
