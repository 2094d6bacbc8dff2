#include "viewer/segment/numbers.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Visits the memory index of each mask voxel of a slice, in order.
template <class Visit>
void forEachOfSlice(const BitMask& mask, int k, const Visit& visit) {
  const glm::ivec3 size = mask.size();
  for (int j = 0; j < size.y; ++j) {
    std::size_t first = (std::size_t(k) * std::size_t(size.y) + std::size_t(j)) * std::size_t(size.x);
    for (std::uint64_t word : mask.row(j, k)) {
      for (; word; word &= word - 1) visit(first + std::size_t(std::countr_zero(word)));
      first += 64;
    }
  }
}

// A value and its number of voxels.
struct CountedValue {
  double value = 0;
  std::int64_t count = 0;
};

// Returns all values in the mask, ascending, without padding. Integers are counted as stored.
template <class T>
std::vector<CountedValue> countedValues(const BitMask& mask, const Volume& volume,
                                        const std::vector<T>& stored) {
  constexpr int least = std::numeric_limits<T>::min();
  constexpr std::size_t kinds = std::size_t(1) << (8 * sizeof(T));
  // Each part needs its own counts. Clearing and adding them costs as much as tens of thousands of voxels.
  const int depth = mask.size().z;
  const auto parts =
      int(std::clamp<std::int64_t>(mask.count() / std::int64_t(kinds), 1, std::min(depth, 16)));
  std::vector<std::int64_t> counts(kinds);
  std::mutex mutex;
  parallelFor(parts, 0, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::int64_t> here(kinds);
    for (int k = int(begin * depth / parts); k < int(end * depth / parts); ++k)
      forEachOfSlice(mask, k, [&](std::size_t n) { ++here[std::size_t(int(stored[n]) - least)]; });
    const std::lock_guard lock(mutex);
    for (std::size_t n = 0; n < kinds; ++n) counts[n] += here[n];
  });
  std::vector<CountedValue> values;
  for (std::size_t n = 0; n < kinds; ++n)
    if (const double value = double(volume.realValue(double(int(n) + least)));
        counts[n] && !isPadding(volume.attributes().padding, value))
      values.push_back({value, counts[n]});
  if (volume.slope() < 0) std::ranges::reverse(values);
  return values;
}

// Returns float values one by one in memory order, as they hardly ever repeat.
std::vector<float> floatValues(const BitMask& mask, const Volume& volume, const std::vector<float>& stored) {
  std::vector<std::vector<float>> slices(std::size_t(mask.size().z));
  parallelFor(mask.size().z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k)
      forEachOfSlice(mask, int(k), [&](std::size_t n) {
        const float value = volume.realValue(double(stored[n]));
        if (!isPadding(volume.attributes().padding, double(value))) slices[std::size_t(k)].push_back(value);
      });
  });
  std::vector<float> all;
  all.reserve(std::accumulate(slices.begin(), slices.end(), std::size_t(0),
                              [](std::size_t sum, const auto& slice) { return sum + slice.size(); }));
  for (std::vector<float>& slice : slices) {
    all.insert(all.end(), slice.begin(), slice.end());
    slice = {};
  }
  return all;
}

std::int64_t rankOf(int percent, std::int64_t count) {
  return std::max<std::int64_t>(1, (percent * count + 99) / 100);
}

bool isWhole(double value) { return value == std::round(value); }

SegmentValues numbersOf(const std::vector<CountedValue>& values) {
  SegmentValues out;
  for (const CountedValue& v : values) out.voxels += v.count;
  if (out.voxels == 0) return out;
  out.min = values.front().value, out.max = values.back().value;
  // Sums relative to the minimum keep their digits far from 0.
  double sum = 0, squares = 0;
  for (const CountedValue& v : values) sum += double(v.count) * (v.value - out.min);
  out.mean = out.min + sum / double(out.voxels);
  for (const CountedValue& v : values)
    squares += double(v.count) * (v.value - out.mean) * (v.value - out.mean);
  out.sd = std::sqrt(squares / double(out.voxels));
  const auto atRank = [&](std::int64_t left) {
    auto v = values.begin();
    while (left > v->count) left -= (v++)->count;
    return v->value;
  };
  out.p10 = atRank(rankOf(10, out.voxels));
  out.median = atRank(rankOf(50, out.voxels));
  out.p90 = atRank(rankOf(90, out.voxels));
  out.histogram =
      binsFor({out.min, out.max},
              std::ranges::all_of(values, [](const CountedValue& v) { return isWhole(v.value); }));
  for (const CountedValue& v : values) out.histogram.add(v.value, v.count);
  return out;
}

SegmentValues numbersOf(std::vector<float> values) {
  SegmentValues out;
  out.voxels = std::int64_t(values.size());
  if (values.empty()) return out;
  const auto [least, most] = std::ranges::minmax(values);
  out.min = double(least), out.max = double(most);
  double sum = 0, squares = 0;
  for (const float v : values) sum += double(v) - out.min;
  out.mean = out.min + sum / double(out.voxels);
  for (const float v : values) squares += (double(v) - out.mean) * (double(v) - out.mean);
  out.sd = std::sqrt(squares / double(out.voxels));
  auto from = values.begin();  // everything before it is smaller
  const auto atRank = [&](std::int64_t rank) {
    const auto at = values.begin() + (rank - 1);
    std::nth_element(from, at, values.end());
    from = at;
    return double(*at);
  };
  out.p10 = atRank(rankOf(10, out.voxels));
  out.median = atRank(rankOf(50, out.voxels));
  out.p90 = atRank(rankOf(90, out.voxels));
  out.histogram =
      binsFor({out.min, out.max}, std::ranges::all_of(values, [](float v) { return isWhole(double(v)); }));
  for (const float v : values) out.histogram.add(double(v));
  return out;
}

// Returns the first voxel in memory with `value`; there must be one.
glm::ivec3 firstWith(const BitMask& mask, const Volume& volume, double value) {
  const glm::ivec3 size = mask.size();
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      int first = 0;
      for (std::uint64_t word : mask.row(j, k)) {
        for (; word; word &= word - 1)
          if (const int i = first + std::countr_zero(word); double(volume.value(i, j, k)) == value)
            return {i, j, k};
        first += 64;
      }
    }
  return {};
}

}  // namespace

SegmentValues valuesIn(const BitMask& mask, const Volume& volume) {
  assert(mask.size() == volume.size());
  SegmentValues out = std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        if constexpr (std::is_same_v<T, float>)
          return numbersOf(floatValues(mask, volume, stored));
        else
          return numbersOf(countedValues(mask, volume, stored));
      },
      volume.stored());
  if (out.voxels > 0) out.maxAt = firstWith(mask, volume, out.max);
  return out;
}

std::vector<glm::ivec3> voxelsOf(const BitMask& mask) {
  const glm::ivec3 size = mask.size();
  std::vector<glm::ivec3> voxels;
  voxels.reserve(std::size_t(mask.count()));
  for (int k = 0; k < size.z; ++k)
    forEachOfSlice(mask, k, [&](std::size_t n) {
      voxels.emplace_back(int(n % std::size_t(size.x)), int(n / std::size_t(size.x) % std::size_t(size.y)),
                          k);
    });
  return voxels;
}

}  // namespace volumen
