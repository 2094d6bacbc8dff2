#pragma once

#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The slices of a series as acquired, beside the evenly spaced grid that is drawn of them. None, where both
/// are the same.
struct AcquiredSlices {
  VolumePtr volume{};            ///< their values, slice after slice
  std::vector<double> places{};  ///< where each lies along k of the grid, in slices of that
};

/// A mask of the grid on the slices as acquired: each of their pixels has what the nearest voxel has. On all
/// cores.
BitMask onAcquired(const BitMask& mask, const AcquiredSlices& slices);

}  // namespace volumen
