#pragma once

#include "viewer/kernels/trace.h"
#include "viewer/volume/block_ranges.h"

namespace volumen {

/// What blocks of the volume hold, for projections that need not look at all of them. Real values stand for
/// densities (value - intercept) / slope, slope > 0, rounded to whole numbers where `whole`.
struct BlockValues {
  const BlockRanges* blockRanges = nullptr;  ///< null: everything is looked at
  double slope = 1, intercept = 0;
  double off = 0;  ///< more than floats round the blocks' values by, and interpolation in floats; density
  bool whole = false;
};

/// Extremes or the mean of the density along each ray of a row (picture.md 9), in density units; NaN never.
/// The same bytes with and without `blocks`. `cellByCell`: exact along the rays, whose `ahead` is too (the
/// store is not Store::plane); else of the samples at their steps.
using ProjectKernel = void (*)(const RayInputs&, const BlockValues& blocks, const RayRow&, const PlaneBuffer&,
                               float* result, TraceCounts&);
ProjectKernel chooseProjectKernel(Store store, Mode mode, bool cellByCell);

}  // namespace volumen
