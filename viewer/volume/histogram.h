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

/// The value below which this part (0..1) of what is counted lies, by whole bins.
double valueOfRank(const Histogram& histogram, double part);

/// Values at given ranks, exact (SCENE 5): Pr is the value of rank max(1, ceil(r N / 100)) of all N voxels in
/// ascending order. `perMille`: r * 10, so P0.1 is 1 and P99.9 is 999. Returns one value an entry.
std::vector<float> percentiles(const Volume& volume, const std::vector<int>& perMille);

/// Smallest and largest value of all voxels.
ValueRange valueRange(const Volume& volume);

}  // namespace volumen
