#include "viewer/tables/curve_table.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "viewer/scene/curve_edits.h"

namespace volumen {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double largestDensity = 1e30f;  // limit of volumes

// Returns the density at which the real value reaches `value`. If a whole density means exactly this value,
// returns that density, so that a step on a stored value is a step on its density.
float densityOf(float value, const DensityScale& scale) {
  const double density = (double(value) - scale.intercept) / scale.slope;
  const double whole = std::round(density);
  if (float(scale.slope * whole + scale.intercept) == value && std::abs(whole) < 1e7) return float(whole);
  return float(std::clamp(density, -largestDensity, largestDensity));
}

// Ends the curve where no volume has densities. Points beyond would only be limited, which bends the curve.
TransferFunction withoutEnds(TransferFunction curve, const DensityScale& scale) {
  const double low = scale.intercept - largestDensity * scale.slope;
  const double high = scale.intercept + largestDensity * scale.slope;
  auto& points = curve.points;
  const CurvePoint first = curveAt(curve, low), last = curveAt(curve, high);
  const bool startsBelow = points.front().value<low, endsAbove = points.back().value> high;
  std::erase_if(points, [&](const CurvePoint& p) { return p.value < low || p.value > high; });
  if (startsBelow) points.insert(points.begin(), first);
  if (endsAbove) points.push_back(last);
  return curve;
}

// Limits the slope between nodes that almost coincide: infinity times a distance of 0 would be NaN.
float finiteRise(double rise) { return float(std::clamp(rise, -1e38, 1e38)); }

// Rounds tiny opacities to 0. They show nothing over 1e30 unit distances, and lighting divides by them, which
// overflows floats.
double ordinary(double opacity) { return opacity < 1e-30 ? 0 : opacity; }

// Appends segments in the order of their densities.
class SegmentWriter {
 public:
  SegmentWriter(CurveTable& t, const std::vector<CurvePoint>& points, const std::vector<float>& nodes)
      : t_(t), points_(points), nodes_(nodes) {}

  // Adds a segment between the points `from` and `to`; constant if they are the same.
  void add(std::size_t from, std::size_t to, float end) {
    t_.node.push_back(end);
    t_.start.push_back(nodes_[from]);
    addValues(from, to);
    t_.shownBefore.push_back(shown_);
    if (points_[from].opacity > 0 || points_[to].opacity > 0) ++shown_;
    t_.shownUpTo.push_back(shown_);
  }

 private:
  double width(std::size_t from, std::size_t to) const { return double(nodes_[to]) - nodes_[from]; }

  void addValues(std::size_t from, std::size_t to) {
    const CurvePoint &a = points_[from], &b = points_[to];
    const auto add = [&](std::vector<float>& at, std::vector<float>& rise, double p, double q) {
      at.push_back(float(p));
      rise.push_back(finiteRise(from == to ? 0 : (q - p) / width(from, to)));
    };
    add(t_.opacity, t_.opacityRise, ordinary(a.opacity), ordinary(b.opacity));
    add(t_.red, t_.redRise, a.colour.r, b.colour.r);
    add(t_.green, t_.greenRise, a.colour.g, b.colour.g);
    add(t_.blue, t_.blueRise, a.colour.b, b.colour.b);
  }

  CurveTable& t_;
  const std::vector<CurvePoint>& points_;
  const std::vector<float>& nodes_;
  float shown_ = 0;
};

// Sets the range from the last node before any opacity to the first one behind it.
void setVisible(CurveTable& t, const std::vector<CurvePoint>& points, const std::vector<float>& nodes) {
  const auto visible = [](const CurvePoint& p) { return p.opacity > 0; };
  const auto first = std::find_if(points.begin(), points.end(), visible);
  const auto last = std::find_if(points.rbegin(), points.rend(), visible);
  t.visibleLow = infinity;
  t.visibleHigh = -infinity;
  if (first == points.end()) return;
  t.visibleLow = first == points.begin() ? -infinity : nodes[first - points.begin() - 1];
  t.visibleHigh = last == points.rbegin() ? infinity : nodes[points.rend() - last];
}

// Sets the first segment of every bucket, and the largest number of nodes in a bucket.
void setBuckets(CurveTable& t, const DensityScale& scale) {
  t.low = float(scale.low);
  const double width = scale.high - scale.low;
  // Finite, so that no product with 0 is NaN.
  t.perBucket = width > 0 ? float(std::min(CurveTable::buckets / width, 1e30)) : 0.0f;
  // Uses the same float arithmetic as the kernels, so that a density and a node never change places.
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
}

}  // namespace

std::size_t CurveTable::bytes() const { return (first.size() + 12 * node.size()) * 4; }

CurveTable makeCurveTable(const TransferFunction& curve, const DensityScale& scale) {
  CurveTable t;
  const std::vector<CurvePoint> points = withoutEnds(curve, scale).points;
  std::vector<float> nodes;
  for (const CurvePoint& p : points) {
    const float node = densityOf(p.value, scale);
    // Distinct values must remain distinct densities.
    const bool isRoundedAway =
        !nodes.empty() && node <= nodes.back() && p.value > points[nodes.size() - 1].value;
    nodes.push_back(isRoundedAway ? std::nextafter(nodes.back(), infinity) : node);
  }
  SegmentWriter writer(t, points, nodes);
  writer.add(0, 0, nodes.front());
  // No density lies between two nodes at the same density.
  for (std::size_t n = 0; n + 1 < points.size(); ++n)
    if (nodes[n] < nodes[n + 1]) writer.add(n, n + 1, nodes[n + 1]);
  writer.add(points.size() - 1, points.size() - 1, infinity);

  t.segments = int(t.node.size());
  const std::size_t padded = std::max<std::size_t>(t.node.size(), CurveTable::padding);
  for (auto* values : {&t.start, &t.opacity, &t.opacityRise, &t.shownBefore, &t.shownUpTo, &t.red, &t.redRise,
                       &t.green, &t.greenRise, &t.blue, &t.blueRise})
    values->resize(padded, 0.0f);
  t.node.resize(padded, infinity);
  setVisible(t, points, nodes);
  setBuckets(t, scale);
  return t;
}

}  // namespace volumen
