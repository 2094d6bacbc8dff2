#include "viewer/plan/visibility.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "viewer/scene/visible_range.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Blocks bounded from below by one of the levels first .. last are visible if level `high` or a higher one
// bounds them from above.
struct Reach {
  std::uint8_t first, last, high;
};

std::vector<Reach> visibleReaches(const TransferFunction& curve, const std::vector<float>& levels,
                                  double rounding) {
  const std::vector<ValueRange> spans = visibleSpans(curve);
  const auto isVisible = [&](float low, float high) {
    // A constant 0, the background of many volumes, is interpolated exactly.
    const float least = low < high ? 1e-36f : 0.0f;
    const float off = float(rounding) + 4e-7f * std::max(std::abs(low), std::abs(high)) + least;
    return std::any_of(spans.begin(), spans.end(), [&](const ValueRange& s) {
      return high + off >= float(s.low) && low - off <= float(s.high);
    });
  };
  std::vector<Reach> reaches;
  for (std::size_t low = 0; low < levels.size(); ++low) {
    // The farther a block reaches up, the more it holds.
    const auto first = levels.begin() + std::ptrdiff_t(low);
    const auto at = std::partition_point(first, levels.end(), [&](float h) { return !isVisible(*first, h); });
    if (at == levels.end()) continue;
    const auto high = std::uint8_t(at == first ? 0 : at - levels.begin());
    if (!reaches.empty() && reaches.back().last + 1u == low && reaches.back().high == high)
      reaches.back().last = std::uint8_t(low);
    else
      reaches.push_back({std::uint8_t(low), std::uint8_t(low), high});
  }
  return reaches;
}

// Sets flags[0 .. count), which are 0.
void markVisible(const std::vector<Reach>& reaches, const std::uint8_t* lowest, const std::uint8_t* highest,
                 std::size_t count, std::uint8_t* flags) {
  for (const Reach r : reaches)
    for (std::size_t n = 0; n < count; ++n)
      flags[n] |= std::uint8_t((lowest[n] >= r.first) & (lowest[n] <= r.last) & (highest[n] >= r.high));
}

constexpr std::size_t chunk = 1 << 13;  // blocks that are looked at together: they stay in the cache

// Calls take(begin, end) for chunks of all blocks, on all cores.
template <class Take>
void forChunks(std::size_t blocks, const Take& take) {
  parallelFor(std::int64_t((blocks + chunk - 1) / chunk), 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::size_t n = std::size_t(begin); n < std::size_t(end); ++n)
      take(n * chunk, std::min(blocks, (n + 1) * chunk));
  });
}

}  // namespace

std::vector<std::uint8_t> visibleBlocks(const TransferFunction& curve, const BrickRanges& bricks,
                                        double rounding) {
  const std::vector<Reach> reaches = visibleReaches(curve, bricks.levels, rounding);
  std::vector<std::uint8_t> visible(bricks.size());
  forChunks(visible.size(), [&](std::size_t begin, std::size_t end) {
    markVisible(reaches, &bricks.lowest[begin], &bricks.highest[begin], end - begin, &visible[begin]);
  });
  return visible;
}

std::int64_t visibleBlockCount(const TransferFunction& curve, const BrickRanges& bricks) {
  const std::vector<Reach> reaches = visibleReaches(curve, bricks.levels, 0);
  std::atomic<std::int64_t> count = 0;
  forChunks(bricks.size(), [&](std::size_t begin, std::size_t end) {
    std::uint8_t flags[chunk] = {};
    markVisible(reaches, &bricks.lowest[begin], &bricks.highest[begin], end - begin, flags);
    count += std::accumulate(flags, flags + (end - begin), std::int64_t(0));
  });
  return count;
}

std::int64_t VisibleCountMemo::of(const TransferFunction& curve, const BrickRanges& bricks) {
  const std::lock_guard lock(mutex_);
  if (count_ && points_ == curve.points) return *count_;
  count_ = visibleBlockCount(curve, bricks);
  points_ = curve.points;
  return *count_;
}

}  // namespace volumen
