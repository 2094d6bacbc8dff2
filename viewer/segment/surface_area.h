#pragma once

#include "viewer/segment/bit_mask.h"

namespace volumen {

/// The area of the boundary of a mask, mm^2, by Crofton's formula: how often its boundary is crossed along 13
/// directions of the grid, weighted by each direction's share of the sphere (the Voronoi cells of +-d of the
/// physical directions, so that anisotropic and sheared grids are measured right). What lies outside the grid
/// is not in the mask. Within 2 % on balls and ellipsoids of 10 voxels or more across; tilted cylinders come
/// out up to 6 % smaller on sheared grids and thick slices, flat faces along the planes of the grid come out
/// smaller, by 7 % on even grids, by up to 30 % where slices are thick. On all cores. (Lang, Ohser and Hilfer
/// 2001)
double boundaryArea(const BitMask& mask);

}  // namespace volumen
