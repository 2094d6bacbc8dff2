#include "io/dicom/entries.h"

#include <algorithm>

namespace volumen::dicom {

double samePlaceMm(const Entries& entries) {
  const Slice& s = entries[0].slice();
  return isPlaced(s) ? 0.01 * std::min(s.spacing->x, s.spacing->y) : 0.5;
}

std::vector<Entries> byPlace(const Entries& entries) {
  std::vector<Entries> places;
  const double same = samePlaceMm(entries);
  for (const Entry& e : entries) {
    if (places.empty() || e.placed.alongNormal - places.back()[0].placed.alongNormal > same)
      places.emplace_back();
    places.back().push_back(e);
  }
  return places;
}

std::size_t mostAtOnePlace(const Entries& entries) {
  const double same = samePlaceMm(entries);
  std::size_t most = 0, first = 0;
  for (std::size_t n = 0; n < entries.size(); ++n) {
    if (entries[n].placed.alongNormal - entries[first].placed.alongNormal > same) first = n;
    most = std::max(most, n - first + 1);
  }
  return most;
}

long firstNumber(const Entries& entries) {
  long first = entries[0].slice().instance;
  for (const Entry& e : entries) first = std::min(first, e.slice().instance);
  return first;
}

std::vector<PlacedSlice> placedSlices(const Entries& entries) {
  std::vector<PlacedSlice> slices;
  for (const Entry& e : entries) slices.push_back(e.placed);
  return slices;
}

}  // namespace volumen::dicom
