#pragma once

#include "io/dicom/stack.h"

namespace volumen::dicom {

/// Returns the slices of a regular grid: copies, and linear interpolations between neighbours, rounded to
/// nearest for integer values. `sliceVoxels` is the number of voxels of a slice.
VoxelValues resampleSlices(const VoxelValues& acquired, std::size_t sliceVoxels,
                           const std::vector<Stack::Source>& sources);

}  // namespace volumen::dicom
