#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "viewer/measure/shape.h"
#include "viewer/slice/plane.h"

namespace volumen {

/// The visible part of a shape in a flat view, in patient mm.
struct ShapeCut {
  bool whole = false;  ///< True if all of the shape is visible: it was drawn on this plane.
  /// Lines through these points. A single point is a mark. A line whose ends coincide is closed.
  std::vector<std::vector<glm::dvec3>> lines;
};

/// Returns the distance, mm, from a view's plane within which a shape is shown in full. It is half a step of
/// the wheel, or half the slab if that is thicker.
double seenWithin(const SlicePlane& plane, const VoxelGeometry& geometry);

/// Returns the part of a shape within -halfMm <= d < halfMm of a plane, with d along its normal. This holds
/// for lines and points. A region inside the layer is shown whole. Any other is shown as the lines in which
/// the plane cuts its inside, none if both are parallel. Ellipses are lines with `ellipseCorners` corners.
/// Volumes are not shown. `shape` must pass checkShape().
ShapeCut cutOf(const Shape& shape, const SlicePlane& plane, double halfMm);
inline constexpr int ellipseCorners = 180;

/// Returns the corners of a region's edge, in patient mm; the last is joined to the first. Ellipses as above.
std::vector<glm::dvec3> edgeOf(const Shape& region);

/// Returns the middle of a shape, in patient mm: of a region's bounding box, else the mean of its points. The
/// shape must have points.
glm::dvec3 middleOf(const Shape& shape);

}  // namespace volumen
