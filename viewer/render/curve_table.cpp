#include "viewer/render/curve_table.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace volumen {

namespace {

// The density at which the real value reaches `value`. Where a whole density means exactly this value, it is
// that one, so that a step on a stored value is a step on that density.
float densityOf(float value, const DensityScale& scale) {
  const double density = (double(value) - scale.intercept) / scale.slope;
  const double whole = std::round(density);
  if (float(scale.slope * whole + scale.intercept) == value && std::abs(whole) < 1e7) return float(whole);
  return float(std::clamp(density, -1e30, 1e30));
}

// From the last node before any opacity to the first one behind it.
void setVisible(CurveTable& t, const std::vector<CurvePoint>& points, const std::vector<float>& nodes) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const auto visible = [](const CurvePoint& p) { return p.opacity > 0; };
  const auto first = std::find_if(points.begin(), points.end(), visible);
  const auto last = std::find_if(points.rbegin(), points.rend(), visible);
  t.visibleLow = infinity;
  t.visibleHigh = -infinity;
  if (first == points.end()) return;
  t.visibleLow = first == points.begin() ? -infinity : nodes[first - points.begin() - 1];
  t.visibleHigh = last == points.rbegin() ? infinity : nodes[points.rend() - last];
}

}  // namespace

std::size_t CurveTable::bytes() const { return (first.size() + 12 * node.size()) * 4; }

CurveTable makeCurveTable(const TransferFunction& curve, const DensityScale& scale) {
  CurveTable t;
  const auto& points = curve.points;
  std::vector<float> nodes;
  for (const CurvePoint& p : points) nodes.push_back(densityOf(p.value, scale));
  const auto addSegment = [&](std::size_t from, std::size_t to, float end) {
    const CurvePoint &a = points[from], &b = points[to];
    const double width = double(nodes[to]) - nodes[from];
    const auto rise = [&](double p, double q) { return float(width > 0 ? (q - p) / width : 0); };
    t.node.push_back(end);
    t.start.push_back(nodes[from]);
    t.opacity.push_back(float(a.opacity)), t.opacityRise.push_back(rise(a.opacity, b.opacity));
    t.red.push_back(float(a.colour.r)), t.redRise.push_back(rise(a.colour.r, b.colour.r));
    t.green.push_back(float(a.colour.g)), t.greenRise.push_back(rise(a.colour.g, b.colour.g));
    t.blue.push_back(float(a.colour.b)), t.blueRise.push_back(rise(a.colour.b, b.colour.b));
  };
  const auto extinction = [](double opacity) { return -std::log1p(-std::min(opacity, 1 - 0x1p-20)); };
  const auto change = [&](const CurvePoint& a, const CurvePoint& b) {
    const glm::dvec3 c = glm::abs(b.colour - a.colour);
    const double before = extinction(a.opacity), behind = extinction(b.opacity);
    return std::abs(behind - before) + std::max({c.r, c.g, c.b}) * std::max(before, behind);
  };
  double varied = 0;
  std::size_t at = 0;
  // Steps between the last segment's end and this one's start count whole.
  const auto addVariation = [&](std::size_t from, std::size_t to) {
    for (; at < from; ++at) varied += change(points[at], points[at + 1]);
    t.variation.push_back(float(varied));
    t.variationRise.push_back(
        from == to ? 0.0f : float(change(points[from], points[to]) / (double(nodes[to]) - nodes[from])));
    for (; at < to; ++at) varied += change(points[at], points[at + 1]);
  };
  addSegment(0, 0, nodes.front());
  addVariation(0, 0);
  // No density lies between two nodes at one place.
  for (std::size_t n = 0; n + 1 < points.size(); ++n)
    if (nodes[n] < nodes[n + 1]) {
      addSegment(n, n + 1, nodes[n + 1]);
      addVariation(n, n + 1);
    }
  addSegment(points.size() - 1, points.size() - 1, std::numeric_limits<float>::infinity());
  addVariation(points.size() - 1, points.size() - 1);

  t.segments = int(t.node.size());
  for (auto* values : {&t.start, &t.variation, &t.variationRise, &t.opacity, &t.opacityRise, &t.red,
                       &t.redRise, &t.green, &t.greenRise, &t.blue, &t.blueRise})
    values->resize(std::max<std::size_t>(values->size(), CurveTable::padding), 0.0f);
  t.node.resize(std::max<std::size_t>(t.node.size(), CurveTable::padding),
                std::numeric_limits<float>::infinity());
  setVisible(t, points, nodes);

  t.low = float(scale.low);
  const double width = scale.high - scale.low;
  t.perBucket = width > 0 ? float(CurveTable::buckets / width) : 0.0f;
  // The same float arithmetic as in the kernels, so that a density and a node never change places.
  const auto bucketOf = [&](float density) {
    const float b = (density - t.low) * t.perBucket;
    return int(std::clamp(b, 0.0f, float(CurveTable::buckets - 1)));
  };
  std::vector<int> inBucket(CurveTable::buckets, 0);
  for (int s = 0; s + 1 < t.segments; ++s) ++inBucket[bucketOf(t.node[s])];
  t.first.resize(CurveTable::buckets);
  for (int b = 0, before = 0; b < CurveTable::buckets; ++b) {
    t.first[b] = before;
    before += inBucket[b];
    t.hops = std::max(t.hops, inBucket[b]);
  }
  return t;
}

}  // namespace volumen
