#pragma once

#include "io/dicom/stack.h"

namespace volumen::dicom {

/// Sorts the pictures of many files into volumes (design.md 7): by series, then by what makes different
/// volumes of one series (size, orientation, pixel spacing, echo), then by what tells apart pictures of one
/// place (time point, image type, acquisition, ..., else their order), then at large gaps. Ids are not
/// numbered yet. Copies of one picture are left out with a warning.
std::vector<Series> sortIntoSeries(const std::vector<FileHeader>& files);

/// How the values of slices are kept: the smallest of VoxelValues' types that holds them all exactly, with
/// one rescale; float32 with the rescale applied where they differ or are wider.
struct ValuePlan {
  VoxelValues type;       ///< an empty vector of the type
  bool rescaled = false;  ///< slope and intercept are applied already
};
ValuePlan planValues(const std::vector<const FileHeader*>& files, std::span<const PlacedSlice> slices);

}  // namespace volumen::dicom
