#pragma once

#include "io/dicom/stack.h"

namespace volumen::dicom {

/// The volumes and frames of many files.
struct Sorted {
  std::vector<Series> volumes;
  std::vector<const FileHeader*> frames;  ///< pictures at one position that nothing separates: no volume
};

/// Sorts the pictures of many files into volumes (design.md 7). It splits them by identity
/// (io/dicom/identity.h), by size, orientation, pixel spacing and unit, and by line of stacking
/// (io/dicom/lines.h). Then it splits by attributes that separate pictures at one position
/// (io/dicom/split.h), and at large gaps. Volumes are in order of position and of the values that separate
/// them. Ids are not numbered yet. Copies of a picture are left out with a warning.
Sorted sortIntoSeries(const std::vector<FileHeader>& files);

/// How the values of slices are stored: in the smallest type of VoxelValues that holds all of them exactly,
/// with one rescale. Slices of different rescales, or wider ones, become float32 with the rescale applied.
struct ValuePlan {
  VoxelValues type;       ///< an empty vector of the type
  bool rescaled = false;  ///< true if slope and intercept are already applied
};
ValuePlan planValues(const std::vector<const FileHeader*>& files, std::span<const PlacedSlice> slices);

}  // namespace volumen::dicom
