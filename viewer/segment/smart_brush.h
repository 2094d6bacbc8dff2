#pragma once

#include "viewer/segment/brush.h"

namespace volumen {

/// The mean of the values under a brush and so many of their standard deviations (by n) to both sides;
/// padding is no value. None: there is no value.
std::optional<ValueRange> valuesUnder(const VoxelSpans& spans, const Volume& volume, double deviations);

/// Of the voxels under a brush those of a range of values, ends included, that are joined by faces, through
/// such voxels, to one of them; empty where that is none of them. Padding is in no range.
VoxelSpans connectedUnder(const VoxelSpans& spans, const Volume& volume, ValueRange range, glm::ivec3 voxel);

}  // namespace volumen
