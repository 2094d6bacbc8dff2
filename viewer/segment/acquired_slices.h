#pragma once

#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The acquired slices of a series whose evenly spaced grid was resampled from them. Empty if both are the
/// same.
struct AcquiredSlices {
  VolumePtr volume{};            ///< Values, slice after slice
  std::vector<double> places{};  ///< Position of each slice along k of the grid, in grid slices
};

/// Returns a mask of the grid on the acquired slices. Each slice takes the nearest grid slice. Runs on all
/// cores.
BitMask onAcquired(const BitMask& mask, const AcquiredSlices& slices);

/// Returns a mask of the acquired slices on `grid`, which was resampled from them. Each grid slice takes the
/// nearest acquired slice along k. Runs on all cores.
BitMask fromAcquired(const BitMask& onSlices, const AcquiredSlices& slices, const VoxelGeometry& grid);

/// Returns the length along k of each slice, in grid slices: half way to both neighbours, and half a grid
/// slice beyond the outermost ones. `places` (in grid slices, in any order) must differ.
std::vector<double> sharesOf(const std::vector<double>& places);

}  // namespace volumen
