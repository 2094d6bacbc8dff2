#include "viewer/measure/shape_cut.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <optional>

#include "viewer/measure/outline.h"
#include "viewer/slice/smooth_curve.h"

namespace volumen {

namespace {

using glm::dvec3;

// A point this share of the slab's half beyond its limit counts as on it. Rounding thus never hides a shape
// that was drawn halfway between two slices.
constexpr double rounding = 2e-6;
constexpr double samePlace = 1e-6;  // mm

// A layer of space about a plane.
struct Layer {
  dvec3 centre, normal;
  double low, high;  // Distances along the normal, mm.

  double at(dvec3 p) const { return glm::dot(p - centre, normal); }
  bool holds(dvec3 p) const { return at(p) >= low && at(p) < high; }
};

// Returns the position of an outline's coordinates on the plane of its region.
dvec3 onRegion(const ShapePlane& plane, glm::dvec2 p) {
  const glm::dvec2 from = p - onPlane(plane, plane.centre);
  return plane.centre + from.x * plane.right + from.y * plane.down;
}

std::optional<std::vector<dvec3>> clipped(dvec3 a, dvec3 b, const Layer& layer) {
  const double from = layer.at(a), to = layer.at(b);
  if (std::max(from, to) < layer.low || std::min(from, to) >= layer.high) return {};
  const auto partAt = [&](double mm) { return std::clamp((mm - from) / (to - from), 0.0, 1.0); };
  if (from == to) return std::vector{a, b};
  const auto [first, last] = std::minmax({partAt(layer.low), partAt(layer.high)});
  return std::vector{a + first * (b - a), a + last * (b - a)};
}

// Returns the lines of a shape without an inside. A shape still being drawn has those drawn so far.
std::vector<std::vector<dvec3>> linesOf(const Shape& shape) {
  constexpr int partsAPiece = 16;
  const auto& p = shape.points;
  if (shape.kind == ShapeKind::openCurve && p.size() > 2)
    if (const Result<SmoothCurve> curve = SmoothCurve::through(p)) return {curve->line(partsAPiece)};
  if (ruleOf(shape.kind).twoLines && p.size() > 2) return {{p[0], p[1]}, {p.begin() + 2, p.end()}};
  return {p};
}

ShapeCut cutOfLines(const Shape& shape, const Layer& layer) {
  ShapeCut cut;
  for (const std::vector<dvec3>& line : linesOf(shape)) {
    if (line.size() == 1 && layer.holds(line[0])) cut.lines.push_back(line);
    for (std::size_t n = 1; n < line.size(); ++n)
      if (auto part = clipped(line[n - 1], line[n], layer)) {
        if (ruleOf(shape.kind).acrossSlices && !cut.lines.empty() &&
            glm::distance(cut.lines.back().back(), part->front()) < samePlace)
          cut.lines.back().push_back(part->back());
        else
          cut.lines.push_back(std::move(*part));
      }
  }
  return cut;
}

// Returns whether the box around a region lies on one side of the plane.
bool liesBeside(const Shape& region, const Layer& layer) {
  const Outline outline = outlineOf(region);
  int before = 0, behind = 0;
  for (const glm::dvec2 corner :
       {outline.low, outline.high, {outline.low.x, outline.high.y}, {outline.high.x, outline.low.y}}) {
    const double mm = layer.at(onRegion(*region.plane, corner));
    before += mm<-samePlace, behind += mm> samePlace;
  }
  return before == 4 || behind == 4;
}

// Finds where the edge crosses the plane, in order along the line in which the planes meet. Every second
// piece between crossings is inside.
ShapeCut cutOfRegion(const Shape& region, const Layer& layer) {
  ShapeCut cut;
  const dvec3 along = glm::cross(region.plane->normal(), layer.normal);
  if (glm::length(along) < 1e-6 || liesBeside(region, layer)) return cut;
  const std::vector<dvec3> edge = edgeOf(region);
  std::vector<dvec3> crossings;
  for (std::size_t n = 0, last = edge.size() - 1; n < edge.size(); last = n++) {
    const double from = layer.at(edge[last]), to = layer.at(edge[n]);
    if ((from < 0) != (to < 0)) crossings.push_back(edge[last] + from / (from - to) * (edge[n] - edge[last]));
  }
  std::ranges::sort(crossings, {}, [&](dvec3 p) { return glm::dot(p, along); });
  for (std::size_t n = 1; n < crossings.size(); n += 2) cut.lines.push_back({crossings[n - 1], crossings[n]});
  return cut;
}

}  // namespace

double seenWithin(const SlicePlane& plane, const VoxelGeometry& geometry) {
  return std::max(wheelStep(geometry, plane.normal()), plane.slabMm) / 2;
}

std::vector<dvec3> edgeOf(const Shape& region) {
  const Outline outline = outlineOf(region);
  std::vector<dvec3> edge;
  if (outline.ellipse) {
    const glm::dvec2 centre = (outline.low + outline.high) / 2.0, radii = (outline.high - outline.low) / 2.0;
    for (int n = 0; n < ellipseCorners; ++n) {
      const double angle = 2 * std::numbers::pi * n / ellipseCorners;
      edge.push_back(onRegion(*region.plane, centre + radii * glm::dvec2(std::cos(angle), std::sin(angle))));
    }
    return edge;
  }
  for (const glm::dvec2 corner : outline.corners) edge.push_back(onRegion(*region.plane, corner));
  return edge;
}

dvec3 middleOf(const Shape& shape) {
  if (ruleOf(shape.kind).region) {
    const Outline outline = outlineOf(shape);
    return onRegion(*shape.plane, (outline.low + outline.high) / 2.0);
  }
  return std::accumulate(shape.points.begin(), shape.points.end(), dvec3(0)) / double(shape.points.size());
}

ShapeCut cutOf(const Shape& shape, const SlicePlane& plane, double halfMm) {
  if (shape.points.empty()) return {};
  const double most = halfMm * rounding;
  const Layer layer{plane.centre, plane.normal(), -halfMm - most, halfMm - most};
  const bool region = ruleOf(shape.kind).region;
  if (!std::ranges::all_of(shape.points, [&](dvec3 p) { return layer.holds(p); }))
    return region ? cutOfRegion(shape, layer) : cutOfLines(shape, layer);
  ShapeCut cut{true, {}};
  if (!region) {
    cut.lines = linesOf(shape);
    return cut;
  }
  // For a region across a thin layer, it may be that only two corners lie in the layer.
  std::vector<dvec3> edge = edgeOf(shape);
  if (!std::ranges::all_of(edge, [&](dvec3 p) { return layer.holds(p); })) return cutOfRegion(shape, layer);
  edge.push_back(edge.front());
  cut.lines.push_back(std::move(edge));
  return cut;
}

}  // namespace volumen
