#include "viewer/measure/outline.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

namespace volumen {

namespace {

using glm::dvec2;

struct Edge {
  dvec2 from, to;  ///< from.y <= to.y, so that both polygons at an edge compute with the same ends.

  bool spans(double y) const { return from.y <= y && y < to.y; }
  double xAt(double y) const { return from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x); }
};

std::vector<Edge> edgesOf(const std::vector<dvec2>& corners) {
  std::vector<Edge> edges;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const dvec2 a = corners[n], b = corners[(n + 1) % corners.size()];
    edges.push_back(a.y <= b.y ? Edge{a, b} : Edge{b, a});
  }
  return edges;
}

// Returns the y where two edges cross; empty if they do not, or are parallel.
std::optional<double> crossing(const Edge& a, const Edge& b) {
  const dvec2 u = a.to - a.from, v = b.to - b.from, w = b.from - a.from;
  const double cross = u.x * v.y - u.y * v.x;
  if (cross == 0) return {};
  const double s = (w.x * v.y - w.y * v.x) / cross, t = (w.x * u.y - w.y * u.x) / cross;
  if (s < 0 || s > 1 || t < 0 || t > 1) return {};
  return a.from.y + s * u.y;
}

// Returns heights between neighbours of which edges neither end nor cross.
std::vector<double> bandsOf(const std::vector<Edge>& edges) {
  std::vector<double> heights;
  for (std::size_t n = 0; n < edges.size(); ++n) {
    heights.insert(heights.end(), {edges[n].from.y, edges[n].to.y});
    for (std::size_t m = 0; m < n; ++m)
      if (edges[m].from.y < edges[n].to.y && edges[n].from.y < edges[m].to.y)
        if (const auto y = crossing(edges[n], edges[m])) heights.push_back(*y);
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  return heights;
}

// Each band consists of trapezoids, whose area follows from their width in the middle.
double evenOddArea(const std::vector<dvec2>& corners) {
  const std::vector<Edge> edges = edgesOf(corners);
  const std::vector<double> heights = bandsOf(edges);
  double area = 0;
  std::vector<double> xs;
  for (std::size_t n = 1; n < heights.size(); ++n) {
    const double middle = (heights[n - 1] + heights[n]) / 2;
    xs.clear();
    for (const Edge& edge : edges)
      if (edge.spans(middle)) xs.push_back(edge.xAt(middle));
    std::sort(xs.begin(), xs.end());
    for (std::size_t x = 1; x < xs.size(); x += 2)
      area += (xs[x] - xs[x - 1]) * (heights[n] - heights[n - 1]);
  }
  return area;
}

}  // namespace

dvec2 onPlane(const ShapePlane& plane, glm::dvec3 pPatient) {
  return {glm::dot(plane.right, pPatient), glm::dot(plane.down, pPatient)};
}

Outline outlineOf(const Shape& shape) {
  Outline outline{shape.kind == ShapeKind::ellipse, {}, {}, {}};
  for (glm::dvec3 p : shape.points) outline.corners.push_back(onPlane(*shape.plane, p));
  outline.low = outline.high = outline.corners.front();
  for (dvec2 corner : outline.corners) {
    outline.low = glm::min(outline.low, corner);
    outline.high = glm::max(outline.high, corner);
  }
  const auto [low, high] = std::pair(outline.low, outline.high);
  if (shape.kind != ShapeKind::freehand) outline.corners = {low, {high.x, low.y}, high, {low.x, high.y}};
  return outline;
}

bool contains(const Outline& outline, dvec2 point) {
  if (outline.ellipse) {
    const dvec2 radii = (outline.high - outline.low) / 2.0;
    if (radii.x == 0 || radii.y == 0) return false;
    const dvec2 fromCentre = (point - (outline.low + outline.high) / 2.0) / radii;
    return glm::dot(fromCentre, fromCentre) < 1;
  }
  bool inside = false;
  for (std::size_t n = 0, last = outline.corners.size() - 1; n < outline.corners.size(); last = n++) {
    const dvec2 a = outline.corners[last], b = outline.corners[n];
    const Edge edge = a.y <= b.y ? Edge{a, b} : Edge{b, a};
    if (edge.spans(point.y) && point.x < edge.xAt(point.y)) inside = !inside;
  }
  return inside;
}

double areaOf(const Outline& outline) {
  const dvec2 size = outline.high - outline.low;
  if (outline.ellipse) return std::numbers::pi / 4 * size.x * size.y;
  return evenOddArea(outline.corners);
}

}  // namespace volumen
