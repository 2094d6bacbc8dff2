#pragma once

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Returns the mask with its holes filled: voxels that no 6-connected path outside the mask links to the grid
/// border. Returns the mask unchanged if cancelled.
BitMask holesFilled(const BitMask& mask, const CancelToken& cancel = {});
/// Fills the holes of each slice across `axis` (0, 1, 2) separately. Returns the mask unchanged if cancelled.
BitMask holesFilledInSlices(const BitMask& mask, int axis, const CancelToken& cancel = {});

}  // namespace volumen
