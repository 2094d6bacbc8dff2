#pragma once

#include "viewer/segment/bit_mask.h"

namespace volumen {

/// Returns the voxels with range.low <= value <= range.high (holds()) in real units, without padding. Ends
/// may be infinite. Runs on all cores with SIMD.
BitMask voxelsInRange(const Volume& volume, ValueRange range);

}  // namespace volumen
