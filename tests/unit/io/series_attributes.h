#pragma once

#include <set>
#include <span>
#include <vector>

class DcmItem;

namespace volumen::tests {

/// An attribute that tells apart the pictures of a series, to be written by number.
struct SeriesAttribute {
  /// How it may differ in one volume: not at all; from one part to the next; from slice to slice.
  enum class May { stay, change, vary };

  const char* keyword;
  void (*write)(DcmItem&, int n);  ///< value `n`, from 0 to 3
  May may = May::stay;
};

/// Those of classic pictures.
std::span<const SeriesAttribute> seriesAttributes();

/// How often slices in order come back to what others before them were of: their values change more often
/// than there are different ones.
template <class Value>
std::size_t comesBack(const std::vector<Value>& values) {
  std::size_t changes = 0;
  for (std::size_t n = 1; n < values.size(); ++n) changes += values[n] != values[n - 1];
  return changes + 1 - std::set<Value>(values.begin(), values.end()).size();
}

}  // namespace volumen::tests
