#pragma once

#include <cstdint>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// Counts of values in equal bins between low and high. Padding is left out.
struct Histogram {
  double low = 0, high = 0;
  std::vector<std::int64_t> counts;
  double binWidth() const { return counts.empty() ? 0 : (high - low) / double(counts.size()); }
};

/// Histogram over the whole value range; one bin a stored value where integers leave room for that in `bins`.
Histogram histogram(const Volume& volume, int bins = 1024);

/// How often some values occur, in bins of one width.
struct ValueCounts {
  double low = 0,
         width = 1;  ///< of the first bin; it holds low <= v < low + width, the last one its end, too
  std::vector<std::int64_t> counts;  ///< empty: there are no values

  /// One of the values that the bins are for, so many times.
  void add(double value, std::int64_t times = 1);
};

/// At most 64 empty bins for values of which these are the least and the largest. Whole numbers have bins of
/// a whole width about them (low is a half), so that none holds more of them than another; equal values have
/// one bin.
ValueCounts binsFor(ValueRange values, bool areWhole);

/// The value below which this part (0..1) of what is counted lies, by whole bins.
double valueOfRank(const Histogram& histogram, double part);

/// Values at given ranks, exact (picture.md 5): Pr is the value of rank max(1, ceil(r N / 100)) of all N
/// voxels in ascending order. `perMille`: r * 10, so P0.1 is 1 and P99.9 is 999. Returns one value an entry.
std::vector<float> percentiles(const Volume& volume, const std::vector<int>& perMille);

/// Smallest and largest value of all voxels.
ValueRange valueRange(const Volume& volume);

}  // namespace volumen
