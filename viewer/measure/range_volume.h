#pragma once

#include <cstdint>

#include "viewer/volume/cancel.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The volume of the voxels in a range of values, in voxels, computed in two ways (slices.md 4). Multiplied
/// by |det L| it is in mm^3.
struct RangeVolume {
  std::int64_t voxels = 0;  ///< Voxels whose value lies in the range.
  /// Volume where the trilinear value (picture.md 2) lies in the range, inside the volume's box.
  double drawnVoxels = 0;
};

/// Computes both for the values range.low .. range.high, ends included; they may be infinite. Padding is left
/// out: in a cell next to padding each other corner stands for an eighth of the cell. Uses all cores; the
/// result does not depend on their number.
///
/// `drawnVoxels`: The volume is divided into the cells between voxel centres. A cell whose eight corners all
/// lie in the range, or all on one side of it, is known. In other cells the value is linear along each line
/// parallel to the axis of largest change. The fraction of the line inside the range is therefore exact. Over
/// the other two axes these fractions are integrated on squares. A square is quartered until its middle and
/// its corners agree (Simpson's rule). Their differences, summed over all cells, estimate the error. The
/// computation is repeated with a finer tolerance until the error is below 0.05 % of the volume.
///
/// Returns an Error if `cancel` was requested.
Result<RangeVolume> rangeVolume(const Volume& volume, ValueRange range, const CancelToken& cancel = {});

}  // namespace volumen
