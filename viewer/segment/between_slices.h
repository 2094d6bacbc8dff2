#pragma once

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// With the slices between painted ones filled: across the axis (0, 1, 2), of two slices with voxels and only
/// empty ones between them, each of these holds the voxels where the signed distances (mm, in the slice;
/// negative inside) to both outlines, weighted by nearness, sum to 0 or less. Parts of both slices that do
/// not overlap are first moved onto each other by their centroids. Painted slices stay as they are.
BitMask filledBetweenSlices(const BitMask& mask, int axis, const CancelToken& cancel = {});

}  // namespace volumen
