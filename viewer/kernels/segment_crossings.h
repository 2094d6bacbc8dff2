#pragma once

#include <vector>

#include "viewer/acceleration/segment_cells.h"

namespace volumen {

/// A straight line through the box of an occupancy field. The position at t mm is origin + t move, in voxels
/// of the box, whose first voxel is (0, 0, 0).
struct FieldLine {
  glm::dvec3 origin{0}, move{0};
};

/// A crossing of a line with the surface of a segment.
struct FieldCrossing {
  double t = 0;  ///< Distance along the line, mm.
  bool leaves = false;
};

/// Appends, in order, the first `most` crossings of the line with the surface between t0 and t1. The result
/// is the same as that of a search through all cells.
void appendCrossings(const SegmentCells& cells, const FieldLine& line, double t0, double t1, int most,
                     std::vector<FieldCrossing>& crossings);

/// Returns the field's gradient at a position (voxels of the box), in value per voxel of the grid. Sobel is
/// applied at the voxels and interpolated trilinearly between them (picture.md 10).
glm::dvec3 fieldGradient(const OccupancyField& field, glm::dvec3 place);

}  // namespace volumen
