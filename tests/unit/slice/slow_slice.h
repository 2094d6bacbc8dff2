#pragma once

#include <vector>

#include "viewer/slice/plane.h"

namespace volumen::tests {

/// A slice by slices.md 1 in double precision, pixel by pixel. Pixels are `doubtful` if rounding decides: a
/// sample is within 1e-6 voxels of a face of the box or, with `nearest`, of the midpoint between two voxels.
struct SlowSlice {
  std::vector<double> values;
  std::vector<bool> doubtful;
};
SlowSlice slowSlice(const Volume& volume, const SlicePlane& plane);

}  // namespace volumen::tests
