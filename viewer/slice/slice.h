#pragma once

#include <vector>

#include "viewer/slice/plane.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The values of a plane's pixels, first row on top; NaN where the plane lies outside the volume's box.
struct SliceValues {
  glm::ivec2 size{0};
  std::vector<float> values;
};

/// The volume's values on `plane` (SLICE 1), on so many threads (0: all allowed) and with SIMD: the same
/// bytes for any number and on every CPU. Averages are of the slab's values at those sub-samples that have
/// one. Positions are rounded to 2^-24 voxels. An Error for what checkPlane refuses, and where it was
/// cancelled.
Result<SliceValues> resampleSlice(const Volume& volume, const SlicePlane& plane, int threads = 0,
                                  const CancelToken& cancel = {});

}  // namespace volumen
