#pragma once

#include <set>
#include <span>
#include <vector>

class DcmItem;

namespace volumen::tests {

/// An attribute that separates the pictures of a series, written by number.
struct SeriesAttribute {
  /// How the attribute may differ within a volume: not at all, between parts, or from slice to slice.
  enum class May { stay, change, vary };

  const char* keyword;
  void (*write)(DcmItem&, int n);  ///< writes value `n`, from 0 to 3
  May may = May::stay;
};

/// Returns the attributes of classic pictures.
std::span<const SeriesAttribute> seriesAttributes();

/// Returns how often the values of ordered slices return to an earlier one: the number of changes beyond
/// those that distinct values need.
template <class Value>
std::size_t comesBack(const std::vector<Value>& values) {
  std::size_t changes = 0;
  for (std::size_t n = 1; n < values.size(); ++n) changes += values[n] != values[n - 1];
  return changes + 1 - std::set<Value>(values.begin(), values.end()).size();
}

}  // namespace volumen::tests
