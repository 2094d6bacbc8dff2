#pragma once

#include <vector>

#include "viewer/acceleration/segment_cells.h"

namespace volumen {

/// A straight line through the box of an occupancy field: at t mm along it the place origin + t move, in
/// voxels of the box, of which (0, 0, 0) is the first.
struct FieldLine {
  glm::dvec3 origin{0}, move{0};
};

/// Where a line goes through the surface of a segment.
struct FieldCrossing {
  double t = 0;  ///< mm
  bool leaves = false;
};

/// Appends where the line goes through the surface between t0 and t1, in order (picture.md 10): the same as
/// looking at all cells. No more than the first `most`.
void appendCrossings(const SegmentCells& cells, const FieldLine& line, double t0, double t1, int most,
                     std::vector<FieldCrossing>& crossings);

/// The field's gradient at a place (voxels of the box), value per voxel of the grid: Sobel at the voxels,
/// trilinear between them (picture.md 10).
glm::dvec3 fieldGradient(const OccupancyField& field, glm::dvec3 place);

}  // namespace volumen
