#pragma once

#include <cstdint>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// Counts of values in equal bins between low and high, without padding.
struct Histogram {
  double low = 0, high = 0;
  std::vector<std::int64_t> counts;
  double binWidth() const { return counts.empty() ? 0 : (high - low) / double(counts.size()); }
};

/// Returns the histogram of the whole value range, with one bin per stored value if `bins` suffice for the
/// integers.
Histogram histogram(const Volume& volume, int bins = 1024);

/// Counts of values in bins of equal width.
struct ValueCounts {
  double low = 0,
         width = 1;  ///< The first bin is low <= v < low + width; the last bin includes its end
  std::vector<std::int64_t> counts;  ///< Empty if there are no values

  /// Adds a value, which must be in the range of the bins, `times` times.
  void add(double value, std::int64_t times = 1);
};

/// Returns at most 64 empty bins for values between this minimum and maximum. For whole numbers the width is
/// an integer and `low` a half, so that all bins cover equally many numbers. Equal values get one bin.
ValueCounts binsFor(ValueRange values, bool areWhole);

/// Returns the value below which the fraction `part` (0..1) of the counts lies, by whole bins.
double valueOfRank(const Histogram& histogram, double part);

/// Returns exact percentiles (picture.md 5): Pr is the value of rank max(1, ceil(r N / 100)) of all N voxels
/// in ascending order. `perMille` holds r * 10, so P0.1 is 1 and P99.9 is 999. Returns one value per entry.
std::vector<float> percentiles(const Volume& volume, const std::vector<int>& perMille);

/// Returns the smallest and largest value of all voxels.
ValueRange valueRange(const Volume& volume);

}  // namespace volumen
