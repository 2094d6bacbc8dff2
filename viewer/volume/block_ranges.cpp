#include "viewer/volume/block_ranges.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "viewer/volume/extremes.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// With fewer voxels each block covers more samples of a picture, and more of these lie in its invisible part.
// Small volumes therefore get smaller blocks.
int edgeFor(const VoxelGeometry& geometry) {
  const std::int64_t voxels = geometry.voxelCount();
  return voxels <= 1 << 15 ? 1 : voxels <= 1 << 18 ? 2 : 4;
}

// Computes the ranges of one line of blocks (b, c), upper faces included: first across the rows of the line
// per voxel, then along x.
template <class T>
void lineRange(const std::vector<T>& stored, glm::ivec3 size, int edge, int b, int c, std::vector<T>& lowest,
               std::vector<T>& highest) {
  lowest.assign(size.x, std::numeric_limits<T>::max());
  highest.assign(size.x, std::numeric_limits<T>::lowest());
  for (int k = c * edge; k <= std::min(c * edge + edge, size.z - 1); ++k)
    for (int j = b * edge; j <= std::min(b * edge + edge, size.y - 1); ++j) {
      const T* row = stored.data() + (std::size_t(k) * size.y + j) * std::size_t(size.x);
      rowPasses<T>().takeInRange(row, std::size_t(size.x), lowest.data(), highest.data());
    }
}

// Returns a sorted sample of the blocks' values at irregular distances: a stride would hit the same columns
// of blocks again.
std::vector<float> someOf(const std::vector<float>& values) {
  constexpr std::size_t most = 1 << 14;
  std::vector<float> some(std::min(values.size(), most));
  const double stride = double(values.size()) / double(some.size());
  for (std::size_t n = 0; n < some.size(); ++n) {
    const double chance = double(n) * 0.6180339887498949, place = double(n) + chance - std::floor(chance);
    some[n] = values[values.size() > most ? std::size_t(place * stride) : n];
  }
  std::sort(some.begin(), some.end());
  return some;
}

// Returns distinct values of a sorted sequence. Each has at least a factor of 1 + share more values before it
// than the last one taken.
template <class Iterator>
std::vector<float> everyShare(Iterator begin, Iterator end, double share) {
  std::vector<float> taken;
  double next = 0;
  for (Iterator at = begin; at != end; ++at) {
    if (double(at - begin) < next || (!taken.empty() && *at == taken.back())) continue;
    taken.push_back(*at);
    next = double(at - begin + 1) * (1 + share);
  }
  return taken;
}

// Returns at most `most` values, by the smallest share that suffices.
template <class Iterator>
std::vector<float> fewOf(Iterator begin, Iterator end, std::size_t most) {
  std::vector<float> few = everyShare(begin, end, 0);
  if (few.size() <= most) return few;
  double low = 0, high = 1;
  for (int n = 0; n < 12; ++n) {
    const double share = (low + high) / 2;
    auto taken = everyShare(begin, end, share);
    if (taken.size() > most) {
      low = share;
    } else {
      high = share;
      few = std::move(taken);
    }
  }
  return few;
}

// A curve shows blocks that reach up to some value, or down to one. Levels are placed so that rounding to the
// next one adds few blocks.
std::vector<float> levelsOf(const std::vector<float>& low, const std::vector<float>& high) {
  if (low.empty()) return {};
  const float least = *std::min_element(low.begin(), low.end()),
              largest = *std::max_element(high.begin(), high.end());
  constexpr int fromAbove = 150, fromBelow = 80, even = 20;
  static_assert(fromAbove + fromBelow + even + 3 <= BlockRanges::mostLevels);
  const std::vector<float> lows = someOf(low), highs = someOf(high);
  std::vector<float> levels = fewOf(highs.rbegin(), highs.rend(), fromAbove);
  const std::vector<float> below = fewOf(lows.begin(), lows.end(), fromBelow);
  levels.insert(levels.end(), below.begin(), below.end());
  levels.insert(levels.end(), {least, largest});
  if (least < 0 && largest > 0) levels.push_back(0);
  for (int n = 1; n <= even; ++n) levels.push_back(float(least + (double(largest) - least) * n / (even + 1)));
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

// Finds the levels next to values between the first and the last level.
class LevelSearch {
 public:
  explicit LevelSearch(const std::vector<float>& levels)
      : levels_(levels),
        least_(levels.front()),
        perValue_(levels.back() > levels.front() ? buckets / (double(levels.back()) - least_) : 0) {
    // first_[b] is the number of levels in earlier buckets.
    for (float level : levels) ++first_[bucketOf(level) + 1];
    for (int b = 0; b < buckets; ++b) first_[b + 1] = std::uint16_t(first_[b + 1] + first_[b]);
  }

  // Returns the largest level not above `value`.
  std::uint8_t below(float value) const { return std::uint8_t(levelsUpTo<std::less_equal<>>(value) - 1); }
  // Returns the smallest level not below `value`.
  std::uint8_t above(float value) const { return std::uint8_t(levelsUpTo<std::less<>>(value)); }

 private:
  static constexpr int buckets = 1 << 14;
  // Returns the number of levels below `value`, or not above it.
  template <class IsBefore>
  std::size_t levelsUpTo(float value) const {
    const std::size_t b = bucketOf(value), first = first_[b], count = first_[b + 1] - first;
    if (count <= 1) return first + (count & std::size_t(IsBefore()(levels_[first - 1 + count], value)));
    const auto from = levels_.begin() + std::ptrdiff_t(first);
    const auto isBefore = [&](float level) { return IsBefore()(level, value); };
    return std::size_t(std::partition_point(from, from + std::ptrdiff_t(count), isBefore) - levels_.begin());
  }
  std::size_t bucketOf(float value) const {
    return std::size_t(std::min((double(value) - least_) * perValue_, buckets - 1.0));
  }

  const std::vector<float>& levels_;
  double least_, perValue_;
  std::vector<std::uint16_t> first_ = std::vector<std::uint16_t>(buckets + 1);
};

}  // namespace

BlockRanges blockRangesOf(int edge, glm::ivec3 count, const std::vector<float>& low,
                          const std::vector<float>& high) {
  BlockRanges blockRanges{edge, count, levelsOf(low, high), {}, {}, {}};
  if (low.empty()) return blockRanges;
  blockRanges.lowest.resize(low.size());
  blockRanges.highest.resize(low.size());
  const LevelSearch search(blockRanges.levels);
  constexpr std::size_t chunk = 1 << 12;
  parallelFor(std::int64_t((low.size() + chunk - 1) / chunk), 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::size_t n = begin * chunk; n < std::min(low.size(), end * chunk); ++n) {
      blockRanges.lowest[n] = search.below(low[n]);
      blockRanges.highest[n] = search.above(high[n]);
    }
  });
  blockRanges.counts.resize(blockRanges.levels.size() * blockRanges.levels.size());
  for (std::size_t n = 0; n < low.size(); ++n)
    ++blockRanges.counts[blockRanges.lowest[n] * blockRanges.levels.size() + blockRanges.highest[n]];
  return blockRanges;
}

BlockRanges blockRanges(const Volume& volume) {
  const glm::ivec3 size = volume.size();
  const int edge = edgeFor(volume.geometry());
  const glm::ivec3 count = (size + (edge - 1)) / edge;
  const std::size_t total = std::size_t(count.x) * count.y * count.z;
  std::vector<float> lows(total), highs(total);
  std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        parallelFor(std::int64_t(count.y) * count.z, 0, [&](std::int64_t begin, std::int64_t end) {
          std::vector<T> low, high;
          for (std::int64_t line = begin; line < end; ++line) {
            lineRange(stored, size, edge, int(line % count.y), int(line / count.y), low, high);
            for (int a = 0; a < count.x; ++a) {
              const int first = a * edge, last = std::min(first + edge, size.x - 1);
              const float p = volume.realValue(*std::min_element(&low[first], &low[last] + 1));
              const float q = volume.realValue(*std::max_element(&high[first], &high[last] + 1));
              const std::size_t n = std::size_t(line) * count.x + a;
              lows[n] = std::min(p, q);
              highs[n] = std::max(p, q);
            }
          }
        });
      },
      volume.stored());
  return blockRangesOf(edge, count, lows, highs);
}

}  // namespace volumen
