#include "viewer/volume/histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "viewer/volume/extremes.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr std::int64_t chunk = 1 << 20;  // voxels per task: small enough to share, large enough to be cheap

constexpr int mostBins = 64;  // largest number of bins of binsFor()

// Calls work(first, last) for runs of voxels on all cores.
void overVoxels(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) {
  const std::int64_t chunks = (std::int64_t(count) + chunk - 1) / chunk;
  parallelFor(chunks, 0, [&](std::int64_t begin, std::int64_t end) {
    work(std::size_t(begin * chunk), std::min(count, std::size_t(end * chunk)));
  });
}

// Counts each stored value; entry 0 is the smallest value of the type. Only for 8- and 16-bit integers.
template <class T>
std::vector<std::int64_t> countStored(const std::vector<T>& values) {
  constexpr int bins = 1 << (8 * sizeof(T));
  std::vector<std::int64_t> total(bins, 0);
  std::mutex mutex;
  overVoxels(values.size(), [&](std::size_t first, std::size_t last) {
    std::vector<std::int64_t> local(bins, 0);
    for (std::size_t n = first; n < last; ++n) ++local[int(values[n]) - std::numeric_limits<T>::min()];
    const std::lock_guard lock(mutex);
    for (int b = 0; b < bins; ++b) total[b] += local[b];
  });
  return total;
}

// Values (real units, ascending) and their counts; integers only.
struct CountedValues {
  std::vector<float> values;
  std::vector<std::int64_t> counts;
};

template <class T>
CountedValues countedValues(const Volume& volume, const std::vector<T>& stored) {
  const auto counts = countStored(stored);
  CountedValues out;
  for (std::size_t b = 0; b < counts.size(); ++b) {
    if (counts[b] == 0) continue;
    out.values.push_back(volume.realValue(double(b) + double(std::numeric_limits<T>::min())));
    out.counts.push_back(counts[b]);
  }
  if (volume.slope() < 0) {
    std::reverse(out.values.begin(), out.values.end());
    std::reverse(out.counts.begin(), out.counts.end());
  }
  return out;
}

// Returns the rank of picture.md 5: max(1, ceil(r N / 100)) with r = perMille / 10.
std::int64_t rankOf(int perMille, std::int64_t count) {
  return std::max<std::int64_t>(1, (perMille * count + 999) / 1000);
}

std::vector<float> percentilesOf(const CountedValues& all, const std::vector<int>& perMille,
                                 std::int64_t count) {
  std::vector<float> out;
  for (int p : perMille) {
    std::int64_t left = rankOf(p, count);
    std::size_t n = 0;
    while (left > all.counts[n]) left -= all.counts[n++];
    out.push_back(all.values[n]);
  }
  return out;
}

std::vector<float> percentilesOf(std::vector<float> values, const std::vector<int>& perMille) {
  std::vector<float> out;
  for (int p : perMille) {
    const auto at = values.begin() + (rankOf(p, std::int64_t(values.size())) - 1);
    std::nth_element(values.begin(), at, values.end());
    out.push_back(*at);
  }
  return out;
}

}  // namespace

std::vector<float> percentiles(const Volume& volume, const std::vector<int>& perMille) {
  return std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        if constexpr (std::is_same_v<T, float>)
          return percentilesOf(stored, perMille);  // float volumes store real values
        else
          return percentilesOf(countedValues(volume, stored), perMille, volume.geometry().voxelCount());
      },
      volume.stored());
}

ValueRange valueRange(const Volume& volume) {
  return std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        T low = stored[0], high = stored[0];
        std::mutex mutex;
        overVoxels(stored.size(), [&](std::size_t first, std::size_t last) {
          const auto [a, b] = rowPasses<T>().rangeOf(stored.data() + first, last - first);
          const std::lock_guard lock(mutex);
          low = std::min(low, a);
          high = std::max(high, b);
        });
        const float p = volume.realValue(low), q = volume.realValue(high);
        return ValueRange{std::min(p, q), std::max(p, q)};
      },
      volume.stored());
}

Histogram histogram(const Volume& volume, int bins) {
  const ValueRange range = valueRange(volume);
  Histogram h{range.low, range.high, {}};
  const auto& padding = volume.attributes().padding;
  const auto binOf = [&](float v) {
    if (h.high <= h.low) return 0;
    return std::clamp(int((v - h.low) / (h.high - h.low) * double(h.counts.size())), 0,
                      int(h.counts.size()) - 1);
  };
  std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        if constexpr (std::is_same_v<T, float>) {
          h.counts.assign(bins, 0);
          for (float v : stored)
            if (!isPadding(padding, v)) ++h.counts[binOf(v)];
        } else {
          // Uses one bin per stored value if they suffice: bins of half a value would leave every other one
          // empty.
          const double step = std::abs(volume.slope());
          const double steps = std::round((h.high - h.low) / step) + 1;
          if (steps <= bins) {
            h.low -= step / 2;
            h.high += step / 2;
            bins = int(steps);
          }
          h.counts.assign(bins, 0);
          const CountedValues all = countedValues(volume, stored);
          for (std::size_t n = 0; n < all.values.size(); ++n)
            if (!isPadding(padding, all.values[n])) h.counts[binOf(all.values[n])] += all.counts[n];
        }
      },
      volume.stored());
  return h;
}

void ValueCounts::add(double value, std::int64_t times) {
  const auto bin = std::size_t(std::max(0.0, std::floor((value - low) / width)));
  counts[std::min(bin, counts.size() - 1)] += times;
}

ValueCounts binsFor(ValueRange values, bool areWhole) {
  const auto [least, most] = values;
  ValueCounts bins{.low = least, .counts = {}};
  if (areWhole) {
    bins.width = std::ceil((most - least + 1) / mostBins);
    bins.low = least - 0.5;
  } else if (most > least) {
    bins.width = (most - least) / mostBins;
  }
  const int last = int(std::floor((most - bins.low) / bins.width));
  bins.counts.resize(std::size_t(std::min(last, mostBins - 1) + 1));
  return bins;
}

double valueOfRank(const Histogram& h, double part) {
  std::int64_t all = 0, sum = 0;
  for (std::int64_t count : h.counts) all += count;
  for (std::size_t n = 0; n < h.counts.size(); ++n) {
    sum += h.counts[n];
    if (double(sum) >= part * double(all)) return h.low + (double(n) + 0.5) * h.binWidth();
  }
  return h.high;
}

}  // namespace volumen
