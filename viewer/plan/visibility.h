#pragma once

#include <cstdint>
#include <vector>

#include "viewer/scene/scene.h"
#include "viewer/volume/block_ranges.h"

namespace volumen {

/// Returns one entry per block: 1 if a value between the block's bounds has opacity. The bounds are widened
/// by a few units in the last place, so that rounding in an interpolation cannot escape them (a constant 0 is
/// exact). They are also widened by `rounding`, the largest difference between drawn values and those of the
/// blocks, real units.
std::vector<std::uint8_t> visibleBlocks(const TransferFunction& curve, const BlockRanges& blockRanges,
                                        double rounding = 0);

/// Returns the number of entries that are 1, without `rounding`. Uses BlockRanges::counts, in microseconds.
std::int64_t visibleBlockCount(const TransferFunction& curve, const BlockRanges& blockRanges);

}  // namespace volumen
