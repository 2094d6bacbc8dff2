#pragma once

#include "viewer/segment/bit_mask.h"

namespace volumen {

/// The area of the boundary of a mask, mm^2, by Crofton's formula: how often its boundary is crossed along 13
/// directions of the grid, weighted by each direction's share of the sphere (the Voronoi cells of +-d of the
/// physical directions, so that anisotropic and sheared grids are measured right). Within 2 % on balls,
/// cylinders and ellipsoids of 10 voxels or more across. (Lang, Ohser and Hilfer 2001)
double boundaryArea(const BitMask& mask);

}  // namespace volumen
