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

}  // namespace volumen
