#pragma once

#include <vector>

#include "viewer/segment/bit_mask.h"

namespace volumen {

/// The distance from the centre of each voxel to that of the nearest voxel of a mask, in mm, i fastest:
/// infinite if the mask is empty. The axes of the grid must be perpendicular.
std::vector<float> distancesFrom(const BitMask& mask);

}  // namespace volumen
