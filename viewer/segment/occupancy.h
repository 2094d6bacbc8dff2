#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/segment/label_statistics.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The smoothed occupancy of a segment, 0 to 1: its surface in 3D and in files is where the trilinear field
/// is 1/2. Held in a box of voxels about the segment, at least one voxel larger on every side (also beyond
/// the grid), so that the surface is closed; 0 outside it.
struct OccupancyField {
  VoxelGeometry geometry;     ///< of the whole grid
  VoxelBox box;               ///< in voxels of the grid; may reach one voxel or more beyond it
  std::vector<float> values;  ///< of the box, i fastest
  glm::ivec3 size() const { return box.high - box.low + 1; }
};

/// Gaussian of `sigma` voxels along each axis of the grid (0: none; at most 1), with thin parts kept (what an
/// opening by 2 x 2 x 2 voxels would take away adds min(1, 3 G(0.6))), and clamped to at least 1/2 + 0.02 at
/// voxels of the segment and at most 1/2 - 0.02 at all others: the surface passes between the centres of
/// voxels inside and outside, never elsewhere.
OccupancyField occupancyOf(const BitMask& mask, double sigma, const CancelToken& cancel = {});
inline constexpr double surfaceSigma = 0.7;  ///< voxels: of pictures and of files alike

}  // namespace volumen
