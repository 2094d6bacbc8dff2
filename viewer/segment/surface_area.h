#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "viewer/segment/bit_mask.h"

namespace volumen {

/// A direction along which crossings of a boundary are counted.
struct CrossingDirection {
  glm::ivec3 step{1, 0, 0};   ///< from voxel to voxel; its opposite is counted with it
  double weight = 0;          ///< sum of all weight |unit vector . n| = 1/2, nearly, for every unit vector n
  double areaOfCrossing = 0;  ///< what each counts for, mm^2
};

/// Those of a grid: the steps to the 26 neighbours and others of up to 1.3 times the longest side of a voxel
/// or 2.3 times the edge of a cube as large as it, 8 degrees or more apart.
std::vector<CrossingDirection> crossingDirections(const VoxelGeometry& geometry);

/// The area of the boundary of a mask, mm^2, by Crofton's formula: how often it is crossed along directions
/// of the grid, with weights of the physical directions, so that anisotropic and sheared grids are measured
/// right. What lies outside the grid is not in the mask. How far it is off: resources/docs/segment.md. On all
/// cores; the same for any number of threads. (Lang, Ohser and Hilfer 2001)
double boundaryArea(const BitMask& mask);

}  // namespace volumen
