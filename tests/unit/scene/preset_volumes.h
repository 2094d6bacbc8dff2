#pragma once

#include <numeric>

#include "tests/fixtures/small_volumes.h"

namespace volumen::tests {

/// Returns a row of these values with a modality.
template <class T>
VolumePtr rowOf(std::vector<T> values, const char* modality) {
  VolumeParts parts;
  parts.geometry.size = {int(values.size()), 1, 1};
  parts.values = std::move(values);
  parts.attributes.modality = modality;
  return volumeFrom(std::move(parts));
}

/// Returns one voxel each of 0 .. 999. P1 is 9 and P99.5 is 994 (ranks 10 and 995).
inline VolumePtr countingVolume(const char* modality = "MR") {
  std::vector<std::int16_t> values(1000);
  std::iota(values.begin(), values.end(), std::int16_t(0));
  return rowOf(std::move(values), modality);
}

}  // namespace volumen::tests
