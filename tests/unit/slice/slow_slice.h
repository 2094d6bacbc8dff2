#pragma once

#include <vector>

#include "viewer/slice/plane.h"

namespace volumen::tests {

/// SLICE 1 in double precision, pixel by pixel, to the letter. A pixel of which a sample lies within 1e-6
/// voxels of a face of the box, or with `nearest` of the middle between two voxels, is `doubtful`: rounding
/// decides.
struct SlowSlice {
  std::vector<double> values;
  std::vector<bool> doubtful;
};
SlowSlice slowSlice(const Volume& volume, const SlicePlane& plane);

}  // namespace volumen::tests
