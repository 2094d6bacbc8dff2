#pragma once

#include "io/dicom/stack.h"

namespace volumen::dicom {

/// The slices of a regular grid: copies, and linear interpolations of neighbours (rounded to the nearest
/// where values are integers). `sliceVoxels`: voxels a slice.
VoxelValues resampleSlices(const VoxelValues& acquired, std::size_t sliceVoxels,
                           const std::vector<Stack::Source>& sources);

}  // namespace volumen::dicom
