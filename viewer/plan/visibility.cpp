#include "viewer/plan/visibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "viewer/scene/visible_range.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr std::size_t chunk = 1 << 11;  // blocks that are looked at together: they stay in the cache

// Sets flags[0 .. count), which are 0.
void markVisible(const std::vector<ValueRange>& spans, const float* low, const float* high, float rounding,
                 std::size_t count, std::uint8_t* flags) {
  float lowest[chunk], highest[chunk];
  std::int32_t visible[chunk];
  for (std::size_t n = 0; n < count; ++n) {
    // A constant 0, the background of many volumes, is interpolated exactly.
    const float least = low[n] < high[n] ? 1e-36f : 0.0f;
    const float off = rounding + 4e-7f * std::max(std::abs(low[n]), std::abs(high[n])) + least;
    lowest[n] = low[n] - off;
    highest[n] = high[n] + off;
    visible[n] = 0;
  }
  for (const ValueRange& s : spans) {
    const float from = float(s.low), to = float(s.high);
    for (std::size_t n = 0; n < count; ++n)
      visible[n] |= std::int32_t(highest[n] >= from) & std::int32_t(lowest[n] <= to);
  }
  for (std::size_t n = 0; n < count; ++n) flags[n] = std::uint8_t(visible[n]);
}

}  // namespace

std::vector<std::uint8_t> visibleBlocks(const TransferFunction& curve, const BrickRanges& bricks,
                                        double rounding) {
  const std::vector<ValueRange> spans = visibleSpans(curve);
  std::vector<std::uint8_t> visible(bricks.low.size());
  parallelFor(std::int64_t((visible.size() + chunk - 1) / chunk), 0,
              [&](std::int64_t begin, std::int64_t end) {
                for (std::size_t n = std::size_t(begin) * chunk;
                     n < std::min(visible.size(), std::size_t(end) * chunk); n += chunk)
                  markVisible(spans, &bricks.low[n], &bricks.high[n], float(rounding),
                              std::min(chunk, visible.size() - n), &visible[n]);
              });
  return visible;
}

std::shared_ptr<const VisibleBlocks> VisibleBlocksMemo::of(const TransferFunction& curve,
                                                           const BrickRanges& bricks) {
  const std::lock_guard lock(mutex_);
  if (last_ && points_ == curve.points) return last_;
  auto blocks = std::make_shared<VisibleBlocks>();
  blocks->flags = visibleBlocks(curve, bricks);
  blocks->count = std::accumulate(blocks->flags.begin(), blocks->flags.end(), std::int64_t(0));
  points_ = curve.points;
  last_ = blocks;
  return blocks;
}

std::shared_ptr<const VisibleBlocks> visibleBlocksOf(const TransferFunction& curve,
                                                     const VolumeFacts& facts) {
  return facts.visible ? facts.visible->of(curve, *facts.bricks)
                       : VisibleBlocksMemo().of(curve, *facts.bricks);
}

}  // namespace volumen
