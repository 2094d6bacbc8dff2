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
  double largestError = 0;          ///< how far a written value is from the volume's, at most
  std::optional<int> padding = {};  ///< of real values: the number of those that stand for no picture
};

/// How the samples of a slice are stored in the file that it comes from.
struct StoredAs {
  double slope = 1, intercept = 0;
  bool isSigned = false;
};

/// Slice `k` of a volume: integers as they are; real values by the rescale of their source where that gives
/// them exactly, else as whole numbers, else, where `mayRound`, in 65536 steps from zero to the largest.
/// Padding that no number is has one of its own, the lowest or highest, where no other value has that.
/// Nothing where that is not allowed.
std::optional<StoredSlice> storedSlice(const Volume& volume, int k, const std::optional<StoredAs>& source,
                                       bool mayRound);

}  // namespace volumen
