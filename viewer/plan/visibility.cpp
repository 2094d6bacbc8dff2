#include "viewer/plan/visibility.h"

#include <algorithm>
#include <cmath>

#include "viewer/scene/visible_range.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {
constexpr std::size_t chunk = 1 << 15;  // blocks a task
}

std::vector<std::uint8_t> visibleBlocks(const TransferFunction& curve, const BrickRanges& bricks,
                                        double rounding) {
  const std::vector<ValueRange> spans = visibleSpans(curve);
  std::vector<std::uint8_t> visible(bricks.low.size());
  parallelFor(std::int64_t(visible.size() / chunk + 1), 0, [&](std::int64_t begin, std::int64_t end) {
    const std::size_t first = std::size_t(begin) * chunk,
                      last = std::min(visible.size(), std::size_t(end) * chunk);
    for (const ValueRange& s : spans) {
      const float from = float(s.low), to = float(s.high);
      for (std::size_t n = first; n < last; ++n) {
        const float low = bricks.low[n], high = bricks.high[n];
        const float off = float(rounding) + 4e-7f * std::max(std::abs(low), std::abs(high)) + 1e-36f;
        visible[n] |= std::uint8_t(high + off >= from) & std::uint8_t(low - off <= to);
      }
    }
  });
  return visible;
}

}  // namespace volumen
