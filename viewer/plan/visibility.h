#pragma once

#include <cstdint>
#include <vector>

#include "viewer/plan/facts.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// One entry a block: 1 where a value between the block's smallest and largest has opacity, widened by a few
/// units in the last place, so that rounding in an interpolation cannot escape it.
std::vector<std::uint8_t> visibleBlocks(const TransferFunction& curve, const BrickRanges& bricks);

}  // namespace volumen
