#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// The samples of a slice as 16-bit words, signed ones as their bits: value = slope * stored + intercept.
struct StoredSlice {
  std::vector<std::uint16_t> words;
  bool isSigned = false;
  double slope = 1, intercept = 0;  ///< exactly as decimal() writes them
  double largestError = 0;          ///< largest difference between a written value and the volume's
  std::optional<int> padding = {};  ///< stored number of padding voxels; set for real values only
};

/// How the samples of a slice are stored in its source file.
struct StoredAs {
  double slope = 1, intercept = 0;
  bool isSigned = false;
};

/// Returns how all values of a volume of floats are stored best: as `source` has it if that is exact, else as
/// whole numbers if these are, else in 65536 steps from the lowest to the highest value.
StoredAs storedAsOne(const Volume& volume, const std::optional<StoredAs>& source);
/// Returns slice `k` of a volume of floats in this way, rounded.
StoredSlice roundedSlice(const Volume& volume, int k, StoredAs as);

/// Returns slice `k` of a volume as 16-bit words. Integers stay as they are. Real values use the rescale of
/// their source if it is exact, else whole numbers. If neither is exact and `mayRound`, they are rounded to
/// 65536 steps from zero to the largest value. Padding of real values that has no number gets the lowest or
/// highest one, if no other value uses it. Returns nothing if values are not exact and `mayRound` is false.
std::optional<StoredSlice> storedSlice(const Volume& volume, int k, const std::optional<StoredAs>& source,
                                       bool mayRound);

}  // namespace volumen
