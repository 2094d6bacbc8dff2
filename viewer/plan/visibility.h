#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "viewer/plan/facts.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// One entry a block: 1 where a value between the block's smallest and largest has opacity, widened by a few
/// units in the last place, so that rounding in an interpolation cannot escape it (a constant 0 is exact),
/// and by `rounding`: how far the values that are drawn may be off those of the blocks, real units.
std::vector<std::uint8_t> visibleBlocks(const TransferFunction& curve, const BrickRanges& bricks,
                                        double rounding = 0);

/// visibleBlocks() of the drawn values themselves, and how many they are.
struct VisibleBlocks {
  std::vector<std::uint8_t> flags;
  std::int64_t count = 0;  ///< flags that are 1
};

/// The last VisibleBlocks of a volume: plans of other views, and the frame that is drawn of a plan, ask for
/// the same. For use from several threads at once.
class VisibleBlocksMemo {
 public:
  std::shared_ptr<const VisibleBlocks> of(const TransferFunction& curve, const BrickRanges& bricks);

 private:
  std::mutex mutex_;
  std::vector<CurvePoint> points_;
  std::shared_ptr<const VisibleBlocks> last_;
};

/// Of a volume whose bricks are known.
std::shared_ptr<const VisibleBlocks> visibleBlocksOf(const TransferFunction& curve, const VolumeFacts& facts);

}  // namespace volumen
