#pragma once

#include "viewer/segment/bit_mask.h"

namespace volumen {

/// The voxels where range.low <= value <= range.high (holds()), real units, and the value is no padding; ends
/// may be infinite. On all cores, by SIMD.
BitMask voxelsInRange(const Volume& volume, ValueRange range);

}  // namespace volumen
