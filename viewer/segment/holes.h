#pragma once

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// With what it encloses: voxels that no path of faces outside the mask joins to the border of the grid.
/// Cancelled: as it was.
BitMask holesFilled(const BitMask& mask, const CancelToken& cancel = {});
/// With what it encloses in a slice across an axis of the grid (0, 1, 2), each slice by itself. Cancelled: as
/// it was.
BitMask holesFilledInSlices(const BitMask& mask, int axis, const CancelToken& cancel = {});

}  // namespace volumen
