#pragma once

#include <optional>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// With the slices between painted ones filled: across the axis (0, 1, 2), of two slices with voxels and only
/// empty ones between them, each of these holds the voxels where the signed distances (mm, in the slice;
/// negative inside; from voxel to voxel) to both outlines, weighted by nearness, sum to 0 or less. Parts of
/// one slice that overlap none of the other, the largest first, are moved onto the nearest such part of that
/// one, by their centroids and to whole voxels, and become it on the way. Painted slices stay as they are. A
/// cancelled one is returned half done.
BitMask filledBetweenSlices(const BitMask& mask, int axis, const CancelToken& cancel = {});

/// The axis across which slices were painted: of those across which there are empty slices between ones with
/// voxels the one with the fewest such (of as many, the last); none where there are no empty ones.
std::optional<int> axisOfPaintedSlices(const BitMask& mask);

}  // namespace volumen
