#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// A face between the bricks of two neighbouring voxels.
struct BrickFace {
  glm::ivec3 step{1, 0, 0};  ///< Step to the other voxel
  glm::dvec3 normal{0};      ///< Unit vector, patient space
  double area = 0;           ///< Area in mm^2
};

/// Returns the faces of a brick, one of each opposite pair. Bricks are rectangular on every grid: one edge
/// runs along i, another lies in the plane of i and j. On sheared grids bricks are offset as in a wall, so
/// that a face is shared among several.
std::vector<BrickFace> brickFaces(const VoxelGeometry& geometry);

/// Two Gaussians (standard deviations in mm) for extrapolating the area: `share` times the difference of the
/// narrow and wide result is added to the narrow one.
struct AreaSmoothing {
  double narrowMm = 0, wideMm = 0, share = 0;
};
AreaSmoothing areaSmoothing(const VoxelGeometry& geometry);

/// Returns the area of the boundary of a mask in mm^2. It sums the faces between bricks inside and outside,
/// each projected along the local boundary normal, so that steps add nothing (Coeurjolly, Flin, Teytaud and
/// Tougne 2003). The normal is the gradient of the mask after a Gaussian along the grid axes.
/// Gaussians round edges, which loses area in proportion to their width. The results of two Gaussians are
/// therefore extrapolated to width 0, except where their normals differ by 10 degrees or more, as in thin
/// structures. Nothing outside the grid is in the mask. resources/docs/segment.md states the errors. Runs on
/// all cores, with the same result for any number of threads. If cancelled, returns the sum so far.
/// Three alternatives are worse on the whole. Crofton's formula with up to 80 directions is off by -6.6 %
/// (cylinder 10 x 40 mm) and -13.9 % (box) at worst on slices of 2.5 mm, by -9.3 and -16.0 % on 5 mm. The
/// drawn surface has the steps of thick slices: round bodies are up to 16 % too large on 5 mm. Signed
/// distances in slices make balls of radius 10 on 5 mm 4 to 11 % too large. In the volume they leave the box
/// off by -16 % (Crofton) or -12 % (as drawn).
double boundaryArea(const BitMask& mask, const CancelToken& cancel = {});

}  // namespace volumen
