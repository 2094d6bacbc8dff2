#pragma once

#include <cstdint>
#include <vector>

#include "viewer/scene/scene.h"
#include "viewer/volume/block_ranges.h"

namespace volumen {

/// One entry a block: 1 where a value between the block's bounds has opacity, widened by a few units in the
/// last place, so that rounding in an interpolation cannot escape it (a constant 0 is exact), and by
/// `rounding`: how far the values that are drawn may be off those of the blocks, real units.
std::vector<std::uint8_t> visibleBlocks(const TransferFunction& curve, const BlockRanges& blockRanges,
                                        double rounding = 0);

/// How many of these entries are 1, without rounding: by BlockRanges::blocks, in microseconds.
std::int64_t visibleBlockCount(const TransferFunction& curve, const BlockRanges& blockRanges);

}  // namespace volumen
