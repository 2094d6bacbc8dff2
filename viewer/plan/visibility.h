#pragma once

#include <cstdint>
#include <vector>

#include "viewer/plan/facts.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// One entry a block: 1 where a value between the block's smallest and largest has opacity, widened by a few
/// units in the last place, so that rounding in an interpolation cannot escape it, and by `rounding`: how far
/// the values that are drawn may be off those of the blocks, real units.
std::vector<std::uint8_t> visibleBlocks(const TransferFunction& curve, const BrickRanges& bricks,
                                        double rounding = 0);

}  // namespace volumen
