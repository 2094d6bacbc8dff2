#include "viewer/plan/visibility.h"

#include <algorithm>
#include <cmath>

#include "viewer/scene/visible_range.h"

namespace volumen {

std::vector<std::uint8_t> visibleBlocks(const TransferFunction& curve, const BrickRanges& bricks) {
  const std::vector<ValueRange> spans = visibleSpans(curve);
  std::vector<std::uint8_t> visible(bricks.low.size());
  for (std::size_t n = 0; n < visible.size(); ++n) {
    const double low = bricks.low[n], high = bricks.high[n];
    const double rounding = 4e-7 * std::max({std::abs(low), std::abs(high), 1e-30});
    visible[n] = std::any_of(spans.begin(), spans.end(), [&](const ValueRange& s) {
      return high + rounding >= s.low && low - rounding <= s.high;
    });
  }
  return visible;
}

}  // namespace volumen
