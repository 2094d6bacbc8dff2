#pragma once

#include <vector>

#include "io/dicom/stack.h"

namespace volumen::dicom {

/// A picture and its file.
struct Entry {
  const FileHeader* file;
  PlacedSlice placed;
  const Slice& slice() const { return placed.slice; }
};
using Entries = std::vector<Entry>;

/// Returns the distance along the normal, mm, below which positions are equal. Without positions, it is one
/// of image numbers.
double samePlaceMm(const Entries& entries);

/// Splits entries sorted by position into runs of pictures at one position.
std::vector<Entries> byPlace(const Entries& entries);

/// Returns the largest number of pictures at one position.
std::size_t mostAtOnePlace(const Entries& entries);

/// Returns the lowest InstanceNumber.
long firstNumber(const Entries& entries);

std::vector<PlacedSlice> placedSlices(const Entries& entries);

}  // namespace volumen::dicom
