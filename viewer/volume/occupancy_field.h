#pragma once

#include <vector>

#include "viewer/volume/volume.h"
#include "viewer/volume/voxel_box.h"

namespace volumen {

/// The smoothed occupancy of a segment (occupancyOf), 0 to 1. Its surface, in 3D and in files, is where the
/// trilinear field is 1/2. The box around the segment has at least one more voxel on every side, also beyond
/// the grid, so that the surface is closed. Outside the box the field is 0.
struct OccupancyField {
  VoxelGeometry geometry;     ///< Geometry of the whole grid
  VoxelBox box;               ///< Box in voxels of the grid; may reach one voxel or more beyond it
  std::vector<float> values;  ///< Values of the box, i fastest
  glm::ivec3 size() const { return box.high - box.low + 1; }
};

}  // namespace volumen
