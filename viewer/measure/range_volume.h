#pragma once

#include <cstdint>

#include "viewer/volume/cancel.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The volume of the segment of a range of values, in voxels, in two ways (slices.md 4): times
/// |det L| they are mm^3.
struct RangeVolume {
  std::int64_t voxels = 0;  ///< whose value lies in the range
  double drawnVoxels =
      0;  ///< where the trilinear value (picture.md 2) itself lies in it, inside the volume's box
};

/// Both for the values range.low .. range.high, ends included; they may be infinite. Padding is left out: of
/// a cell beside it each corner that is none stands for its eighth. On all cores, the same for any number of
/// them.
///
/// As drawn: the volume is cut into the cells between voxel centres. A cell whose eight corners all lie in
/// the range, or all on one side of it, is known. In any other the value is linear along each line parallel
/// to the axis that it changes most along, so that the line's part inside the range is exact; over the other
/// two axes these parts are integrated by squares that are cut in four until their middle and their corners
/// agree (Simpson's rule). By what they differ, summed over all cells, the error is estimated; all is done
/// again with a finer tolerance until that is below 0.05 % of the volume. The Error says that `cancel` was
/// asked to.
Result<RangeVolume> rangeVolume(const Volume& volume, ValueRange range, const CancelToken& cancel = {});

}  // namespace volumen
