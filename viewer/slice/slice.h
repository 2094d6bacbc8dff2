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

/// The volume's values on `plane` (slices.md 1), with all cores and SIMD; an Error for planes that are no
/// plane (directions not orthogonal unit vectors, sizes below 1 or above 2^28 pixels, numbers that are not
/// finite). Cancelled: an Error, too.
Result<SliceValues> resampleSlice(const Volume& volume, const SlicePlane& plane, int threads = 0,
                                  const CancelToken& cancel = {});

}  // namespace volumen
