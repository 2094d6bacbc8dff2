#pragma once

#include <vector>

#include "io/dicom/stack.h"

namespace volumen::dicom {

/// A picture with the file it comes from.
struct Entry {
  const FileHeader* file;
  PlacedSlice placed;
  const Slice& slice() const { return placed.slice; }
};
using Entries = std::vector<Entry>;

/// Distances along the normal below this are none, mm; where pictures have no place, of their numbers.
double samePlaceMm(const Entries& entries);

/// Entries in order by place: each a run of pictures at one place.
std::vector<Entries> byPlace(const Entries& entries);

/// How many pictures lie where most do.
std::size_t mostAtOnePlace(const Entries& entries);

/// The least of their numbers.
long firstNumber(const Entries& entries);

/// Their slices.
std::vector<PlacedSlice> placedSlices(const Entries& entries);

}  // namespace volumen::dicom
