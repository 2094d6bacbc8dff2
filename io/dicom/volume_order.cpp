#include "io/dicom/volume_order.h"

#include <algorithm>

namespace volumen::dicom {
namespace {

/// Returns whether two splits differ in one attribute, so that its values order them.
bool differInOne(const Split& a, const Split& b) {
  if (a.by.size() != b.by.size()) return false;
  std::size_t count = 0;
  for (std::size_t n = 0; n < a.by.size(); ++n) {
    if (a.by[n].attribute != b.by[n].attribute) return false;
    count += a.by[n].value != b.by[n].value;
  }
  return count == 1;
}

/// Returns whether each picture of `b` has a higher number than that of `a` in its place.
bool isBehind(const Split& a, const Split& b) {
  for (std::size_t n = 0; n < std::min(a.entries.size(), b.entries.size()); ++n)
    if (b.entries[n].slice().instance <= a.entries[n].slice().instance) return false;
  return true;
}

}  // namespace

void orderByNumbers(std::vector<Split>& splits) {
  constexpr std::size_t most = 2000;  // limit, as comparing all pairs would take minutes
  if (splits.size() > most) return;
  std::vector<std::pair<long, std::size_t>> order;
  for (std::size_t n = 0; n < splits.size(); ++n) order.emplace_back(firstNumber(splits[n].entries), n);
  std::ranges::sort(order);
  for (std::size_t n = 1; n < order.size(); ++n)
    if (!isBehind(splits[order[n - 1].second], splits[order[n].second])) return;
  for (std::size_t n = 0; n < order.size(); ++n)
    for (std::size_t m = 0; m < n; ++m)
      if (order[m].second > order[n].second && differInOne(splits[order[m].second], splits[order[n].second]))
        return;
  std::vector<Split> ordered;
  for (const auto& [number, n] : order) ordered.push_back(std::move(splits[n]));
  splits = std::move(ordered);
}

}  // namespace volumen::dicom
