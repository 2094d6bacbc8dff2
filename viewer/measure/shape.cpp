#include "viewer/measure/shape.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace volumen {

namespace {

// Finding the self-intersections of a freehand outline with more points would take seconds.
constexpr std::size_t mostPoints = 2000;

constexpr ShapeRule rules[] = {
    {ShapeKind::length, "length", 2, 2, "its two ends", false, false, false, true},
    {ShapeKind::polyline, "polyline", 2, mostPoints, "its corners in order", false},
    {.kind = ShapeKind::openCurve,
     .name = "openCurve",
     .fewest = 2,
     .most = mostPoints,
     .points = "that it runs through, in order",
     .region = false,
     .acrossSlices = true},
    {ShapeKind::angle, "angle", 3, 3, "the end of one arm, the vertex, the end of the other", false, false,
     false, true},
    {ShapeKind::cobb, "cobb", 4, 4, "the ends of one line, then those of the other", false, true},
    {ShapeKind::bidirectional, "bidirectional", 4, 4,
     "the ends of the long axis, then those of the short one at right angles to it", false, true},
    {ShapeKind::cardiothoracic, "cardiothoracic", 4, 4,
     "the ends of the heart's width, then those of the thorax's", false, true},
    {ShapeKind::legAxis, "legAxis", 3, 3, "the centres of hip, knee and ankle", false},
    {ShapeKind::ellipse, "ellipse", 2, 2, "two opposite corners of the box around it", true},
    {ShapeKind::rectangle, "rectangle", 2, 2, "two opposite corners", true},
    {ShapeKind::freehand, "freehand", 3, mostPoints, "its corners in order; the last is joined to the first",
     true},
    {ShapeKind::probe, "probe", 1, 1, "the place", false},
    {ShapeKind::arrow, "arrow", 2, 2, "its tip, then its other end", false, false, true},
    {ShapeKind::label, "label", 1, 1, "the place", false, false, true},
    {ShapeKind::volume, "volume", 0, 0, "none", false},
};

// Squares of larger coordinates lose too much precision; no patient is as large.
constexpr double largestCoordinate = 1e9;

bool isPlace(glm::dvec3 p) {
  for (int a = 0; a < 3; ++a)
    if (!(std::abs(p[a]) <= largestCoordinate)) return false;
  return true;
}

Status checkPlane(const ShapePlane& plane) {
  if (!isPlace(plane.centre)) return Error{"plane.centre must be within 1e9 mm."};
  const auto near = [](double x, double wanted) { return std::abs(x - wanted) <= 1e-6; };
  if (!near(glm::length(plane.right), 1)) return Error{"plane.right must be a unit vector."};
  if (!near(glm::length(plane.down), 1)) return Error{"plane.down must be a unit vector."};
  if (!near(glm::dot(plane.right, plane.down), 0))
    return Error{"plane.right and plane.down must be at right angles."};
  return {};
}

Status checkFrame(const Shape& shape) {
  if (shape.frame->number < 0) return Error{"frame.number must not be below 0."};
  if (shape.kind == ShapeKind::volume) return Error{"frame: a volume is not measured on a frame."};
  if (shape.softMm) return Error{"softMm: nothing is picked in 3D on a frame."};
  if (shape.plane && *shape.plane != ShapePlane{}) return Error{"plane: a frame is its own plane."};
  return {};
}

}  // namespace

glm::dvec3 ShapePlane::normal() const { return glm::cross(right, down); }

std::span<const ShapeRule> shapeRules() { return rules; }

const ShapeRule& ruleOf(ShapeKind kind) {
  return *std::find_if(std::begin(rules), std::end(rules),
                       [&](const ShapeRule& rule) { return rule.kind == kind; });
}

Status checkShape(const Shape& shape) {
  const ShapeRule& rule = ruleOf(shape.kind);
  const std::size_t count = shape.points.size();
  if (count < rule.fewest || count > rule.most)
    return Error{"points must hold " + std::to_string(rule.fewest) +
                 (rule.most > rule.fewest ? " to " + std::to_string(rule.most) : "") + " for kind \"" +
                 rule.name + "\" (" + rule.points + "), not " + std::to_string(count) + "."};
  for (std::size_t n = 0; n < count; ++n)
    if (!isPlace(shape.points[n])) return Error{"points[" + std::to_string(n) + "] must be within 1e9 mm."};
  if (rule.region && !shape.plane)
    return Error{std::string("plane is missing; kind \"") + rule.name + "\" is drawn on one."};
  if (shape.plane)
    if (const Status valid = checkPlane(*shape.plane); !valid) return valid;
  if (shape.frame)
    if (const Status valid = checkFrame(shape); !valid) return valid;
  if (shape.softMm && !(*shape.softMm >= 0 && *shape.softMm <= largestCoordinate))
    return Error{"softMm must be a number of mm from 0 to 1e9."};
  if (!(shape.range.low <= shape.range.high)) return Error{"range must be [low, high], low not above high."};
  return {};
}

}  // namespace volumen
