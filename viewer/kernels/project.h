#pragma once

#include "viewer/kernels/trace.h"
#include "viewer/volume/block_ranges.h"

namespace volumen {

/// Ranges of the volume's blocks, for projections that need not sample all of them. Real values stand for
/// densities (value - intercept) / slope with slope > 0, rounded to whole numbers if `whole`.
struct BlockValues {
  const BlockRanges* blockRanges = nullptr;  ///< Null: everything is sampled.
  double slope = 1, intercept = 0;
  /// Bound, in density, on the rounding of the blocks' values and of interpolation in floats.
  double off = 0;
  bool whole = false;
};

/// Computes the extreme or the mean of the density along each ray of a row (picture.md 9), in density units.
/// The result is never NaN. It has the same bytes with and without `blocks`. `cellByCell`: exact along the
/// rays, with exact `ahead`; the store must not be Store::plane. Otherwise computed from the samples at the
/// steps.
using ProjectKernel = void (*)(const RayInputs&, const BlockValues& blocks, const RayRow&, const PlaneBuffer&,
                               float* result, TraceCounts&);
ProjectKernel chooseProjectKernel(Store store, Mode mode, bool cellByCell);

}  // namespace volumen
