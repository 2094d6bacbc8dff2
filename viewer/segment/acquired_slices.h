#pragma once

#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The slices of a series as acquired, beside the evenly spaced grid resampled from them. Empty if both are
/// the same.
struct AcquiredSlices {
  VolumePtr volume{};            ///< Values, slice after slice
  std::vector<double> places{};  ///< Position of each slice along k of the grid, in grid slices
};

/// Returns a mask of the grid on the slices as acquired, by nearest neighbour along k. Runs on all cores.
BitMask onAcquired(const BitMask& mask, const AcquiredSlices& slices);

/// Returns a mask of the slices as acquired on the grid that was resampled from them: each slice of the grid
/// has what the nearest one along k has. Runs on all cores.
BitMask fromAcquired(const BitMask& onSlices, const AcquiredSlices& slices, const VoxelGeometry& grid);

/// Returns the length along k that belongs to each slice: half way to its neighbours, half a grid slice
/// beyond the outermost ones. `places` (in grid slices, in any order) may not be equal.
std::vector<double> sharesOf(const std::vector<double>& places);

}  // namespace volumen
