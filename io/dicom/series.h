#pragma once

#include "io/dicom/stack.h"

namespace volumen::dicom {

/// What many files hold together.
struct Sorted {
  std::vector<Series> volumes;
  std::vector<const FileHeader*> frames;  ///< pictures of one place that nothing tells apart: no volume
};

/// Sorts the pictures of many files into volumes (design.md 7): by whose they are
/// (io/dicom/identity.h), by size, orientation, pixel spacing and unit, by the line along which they are
/// stacked (io/dicom/lines.h), then by what tells apart pictures of one place (io/dicom/split.h), then at
/// large gaps. In the order of places, and of the values that tell them apart. Ids are not numbered yet.
/// Copies of one picture are left out with a warning.
Sorted sortIntoSeries(const std::vector<FileHeader>& files);

/// How the values of slices are kept: the smallest of VoxelValues' types that holds them all exactly, with
/// one rescale; float32 with the rescale applied where they differ or are wider.
struct ValuePlan {
  VoxelValues type;       ///< an empty vector of the type
  bool rescaled = false;  ///< slope and intercept are applied already
};
ValuePlan planValues(const std::vector<const FileHeader*>& files, std::span<const PlacedSlice> slices);

}  // namespace volumen::dicom
