#pragma once

#include "viewer/segment/brush.h"

namespace volumen {

/// Returns the mean of the values under a brush plus and minus `deviations` standard deviations (dividing by
/// n), without padding. Empty if there is no value.
std::optional<ValueRange> valuesUnder(const VoxelSpans& spans, const Volume& volume, double deviations);

/// Returns the voxels under a brush with values in the range (ends included) that are 6-connected to `voxel`
/// through such voxels. Empty if `voxel` is not one of them. Padding is in no range.
VoxelSpans connectedUnder(const VoxelSpans& spans, const Volume& volume, ValueRange range, glm::ivec3 voxel);

}  // namespace volumen
