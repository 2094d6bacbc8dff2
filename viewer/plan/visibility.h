#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "viewer/scene/scene.h"
#include "viewer/volume/bricks.h"

namespace volumen {

/// One entry a block: 1 where a value between the block's bounds has opacity, widened by a few units in the
/// last place, so that rounding in an interpolation cannot escape it (a constant 0 is exact), and by
/// `rounding`: how far the values that are drawn may be off those of the blocks, real units.
std::vector<std::uint8_t> visibleBlocks(const TransferFunction& curve, const BrickRanges& bricks,
                                        double rounding = 0);

/// How many of these entries are 1, without rounding.
std::int64_t visibleBlockCount(const TransferFunction& curve, const BrickRanges& bricks);

/// The last visibleBlockCount() of a volume: plans of other views ask for the same. For use from several
/// threads at once.
class VisibleCountMemo {
 public:
  std::int64_t of(const TransferFunction& curve, const BrickRanges& bricks);

 private:
  std::mutex mutex_;
  std::vector<CurvePoint> points_;
  std::optional<std::int64_t> count_;
};

}  // namespace volumen
