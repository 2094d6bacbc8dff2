#include "viewer/plan/visibility.h"

#include <algorithm>
#include <cmath>

#include "viewer/scene/visible_range.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Blocks whose minimum is one of the levels first .. last are visible if their maximum is at least level
// `high`.
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
    // A block with a higher maximum holds more values.
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

// Sets flags[0 .. count), which must be 0.
void markVisible(const std::vector<Reach>& reaches, const std::uint8_t* lowest, const std::uint8_t* highest,
                 std::size_t count, std::uint8_t* flags) {
  for (const Reach r : reaches)
    for (std::size_t n = 0; n < count; ++n)
      flags[n] |= std::uint8_t((lowest[n] >= r.first) & (lowest[n] <= r.last) & (highest[n] >= r.high));
}

}  // namespace

std::vector<std::uint8_t> visibleBlocks(const TransferFunction& curve, const BlockRanges& blockRanges,
                                        double rounding) {
  const std::vector<Reach> reaches = visibleReaches(curve, blockRanges.levels, rounding);
  std::vector<std::uint8_t> visible(blockRanges.size());
  constexpr std::size_t chunk = 1 << 13;  // blocks processed together, so that they stay in the cache
  const auto chunks = std::int64_t((visible.size() + chunk - 1) / chunk);
  parallelFor(chunks, 0, [&](std::int64_t first, std::int64_t last) {
    for (std::size_t begin = first * chunk; begin < last * chunk; begin += chunk)
      markVisible(reaches, &blockRanges.lowest[begin], &blockRanges.highest[begin],
                  std::min(chunk, visible.size() - begin), &visible[begin]);
  });
  return visible;
}

std::int64_t visibleBlockCount(const TransferFunction& curve, const BlockRanges& blockRanges) {
  const std::size_t levels = blockRanges.levels.size();
  std::int64_t count = 0;
  for (const Reach r : visibleReaches(curve, blockRanges.levels, 0))
    for (std::size_t low = r.first; low <= r.last; ++low)
      for (std::size_t high = r.high; high < levels; ++high) count += blockRanges.counts[low * levels + high];
  return count;
}

}  // namespace volumen
