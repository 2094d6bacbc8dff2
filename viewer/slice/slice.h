#pragma once

#include <functional>
#include <span>
#include <vector>

#include "viewer/slice/plane.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Values of a plane's pixels, first row on top; NaN outside the volume's box.
struct SliceValues {
  glm::ivec2 size{0};
  std::vector<float> values;
};

/// Resamples the volume on `plane` (slices.md 1) with SIMD on `threads` threads (0: all allowed). The bytes
/// are the same for any number of threads and every CPU. Averages are over the sub-samples that have a slab
/// value. Positions are rounded to 2^-24 voxels. The Error means: refused by checkPlane(), or cancelled.
Result<SliceValues> resampleSlice(const Volume& volume, const SlicePlane& plane, int threads = 0,
                                  const CancelToken& cancel = {});

/// Resamples the same values a few rows at a time, from the top, for pictures too large to be held as floats.
/// Calls `use` with the values of whole rows. The Error can also be that of `use`.
Status resampleSliceByRows(const Volume& volume, const SlicePlane& plane,
                           const std::function<Status(std::span<const float>)>& use,
                           const CancelToken& cancel = {});

}  // namespace volumen
