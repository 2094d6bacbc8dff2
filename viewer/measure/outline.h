#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "viewer/measure/shape.h"

namespace volumen {

/// A region's edge in coordinates along its plane's `right` and `down`, mm, from the patient's origin, so
/// that shapes of equal directions share their numbers wherever their planes' centres lie.
struct Outline {
  bool ellipse = false;             ///< the one inside the box from `low` to `high`; else a polygon
  std::vector<glm::dvec2> corners;  ///< of the polygon, in order, the last joined to the first
  glm::dvec2 low{0}, high{0};       ///< the box around it
};

/// The foot of a patient point on a plane, in an outline's coordinates.
glm::dvec2 onPlane(const ShapePlane& plane, glm::dvec3 pPatient);

/// The outline of a region with a plane and points as checkShape wants them.
Outline outlineOf(const Shape& shape);

/// Whether a point lies inside. Half-open: of polygons that abut exactly one holds a point of the edge they
/// share. A polygon that crosses itself holds what it goes around an odd number of times (even-odd).
bool contains(const Outline& outline, glm::dvec2 point);

/// The area inside, mm^2, by the same rule; exact but for rounding.
double areaOf(const Outline& outline);

}  // namespace volumen
