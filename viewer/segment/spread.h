#pragma once

#include <span>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// One row of a structuring element: voxel (i, j, k) spreads to i + low .. i + high of row (j + dj, k + dk).
struct SpreadRow {
  int dj, dk, low, high;
};

/// Dilates a mask by a structuring element, clipped to the grid. Runs on all cores; each row of the element
/// costs about voxels / 128. The result is incomplete if cancelled.
BitMask spread(const BitMask& mask, std::span<const SpreadRow> shape, const CancelToken& cancel);

}  // namespace volumen
