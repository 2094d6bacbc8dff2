#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// A face that the brick of a voxel shares with that of another one.
struct BrickFace {
  glm::ivec3 step{1, 0, 0};  ///< to the other voxel
  glm::dvec3 normal{0};      ///< of length 1, patient space
  double area = 0;           ///< mm^2
};

/// The faces of a brick, one of each two opposite ones. Bricks are rectangular on every grid: one edge runs
/// along i, another in the plane of i and j. On sheared grids they lie as in a wall, and one shares parts of
/// a face with several.
std::vector<BrickFace> brickFaces(const VoxelGeometry& geometry);

/// Standard deviations of two Gaussians, mm, and which multiple of what the narrow one finds more than the
/// wide one is added to it.
struct AreaSmoothing {
  double narrowMm = 0, wideMm = 0, share = 0;
};
AreaSmoothing areaSmoothing(const VoxelGeometry& geometry);

/// The area of the boundary of a mask, mm^2: of the faces between bricks inside and outside, each as it is
/// seen along the normal of the boundary there, so that steps add nothing (Coeurjolly, Flin, Teytaud and
/// Tougne 2003). The normal is the gradient of the mask after a Gaussian along the axes of the grid.
/// Gaussians round edges, which takes area in proportion to their width: what two find is extrapolated to
/// none, except where their normals differ by 10 degrees or more, as they do where something is thin. What
/// lies outside the grid is not in the mask. How far it is off: resources/docs/segment.md. On all cores; the
/// same for any number of threads. Cancelled: of what was done by then.
double boundaryArea(const BitMask& mask, const CancelToken& cancel = {});

}  // namespace volumen
