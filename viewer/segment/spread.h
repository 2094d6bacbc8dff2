#pragma once

#include <span>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// To which voxels of one row a voxel (i, j, k) spreads: i + low .. i + high of row (j + dj, k + dk).
struct SpreadRow {
  int dj, dk, low, high;
};

/// All voxels of the grid to which one of the mask spreads; on all cores, at a cost of about voxels / 128
/// for each row of the shape. A cancelled one is returned half done.
BitMask spread(const BitMask& mask, std::span<const SpreadRow> shape, const CancelToken& cancel);

}  // namespace volumen
