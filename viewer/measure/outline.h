#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "viewer/measure/shape.h"

namespace volumen {

/// A region's edge in mm along its plane's `right` and `down`, from the patient's origin. Shapes of equal
/// directions thus share coordinates wherever the centres of their planes lie.
struct Outline {
  bool ellipse = false;  ///< True: the ellipse inside the box from `low` to `high`. False: a polygon.
  std::vector<glm::dvec2> corners;  ///< Corners of the polygon, in order; the last is joined to the first.
  glm::dvec2 low{0}, high{0};       ///< The bounding box.
};

/// Returns the foot of a patient point on a plane, in an outline's coordinates.
glm::dvec2 onPlane(const ShapePlane& plane, glm::dvec3 pPatient);

/// Returns the outline of a region. Its plane and points must pass checkShape().
Outline outlineOf(const Shape& shape);

/// Returns true if a point lies inside. Edges are half-open: exactly one of two abutting polygons contains a
/// point of their common edge. A polygon that crosses itself contains what it encloses an odd number of times
/// (even-odd rule).
bool contains(const Outline& outline, glm::dvec2 point);

/// Returns the enclosed area, mm^2, by the same rule; exact except for rounding.
double areaOf(const Outline& outline);

}  // namespace volumen
