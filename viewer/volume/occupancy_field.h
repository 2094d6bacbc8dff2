#pragma once

#include <vector>

#include "viewer/volume/volume.h"
#include "viewer/volume/voxel_box.h"

namespace volumen {

/// The smoothed occupancy of a segment (occupancyOf), 0 to 1: its surface in 3D and in files is where the
/// trilinear field is 1/2. Held in a box of voxels about the segment, at least one voxel larger on every side
/// (also beyond the grid), so that the surface is closed; 0 outside it.
struct OccupancyField {
  VoxelGeometry geometry;     ///< of the whole grid
  VoxelBox box;               ///< in voxels of the grid; may reach one voxel or more beyond it
  std::vector<float> values;  ///< of the box, i fastest
  glm::ivec3 size() const { return box.high - box.low + 1; }
};

}  // namespace volumen
