#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "viewer/measure/shape.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// What of a shape is to be seen in a flat view. Patient mm.
struct ShapeCut {
  bool whole = false;  ///< all of it: it was drawn on this plane
  /// Lines through these points; a single point is a mark of its own. Where one end is the other, the line is
  /// closed.
  std::vector<std::vector<glm::dvec3>> lines;
};

/// How far off a view's plane a shape may lie and still be seen in full, mm: half a step of the wheel, and
/// half the slab where that is thicker.
double seenWithin(const SlicePlane& plane, const VoxelGeometry& geometry);

/// The part of a shape that lies within -halfMm <= d < halfMm of a plane, d along its normal: of lines and
/// points. A region that lies in there is whole; of any other it is the lines in which the plane cuts its
/// inside, none where the two are parallel. Ellipses are lines of `ellipseCorners` corners. Volumes have no
/// place. `shape` as checkShape() wants it.
ShapeCut cutOf(const Shape& shape, const SlicePlane& plane, double halfMm);
inline constexpr int ellipseCorners = 180;

/// The corners of a region's edge, in patient mm, the last joined to the first; the ellipse's as above.
std::vector<glm::dvec3> edgeOf(const Shape& region);

/// The middle of a shape: of the box around a region, else the mean of its points. Patient mm; the shape has
/// points.
glm::dvec3 middleOf(const Shape& shape);

}  // namespace volumen
