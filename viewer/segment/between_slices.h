#pragma once

#include <optional>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Returns the mask with the empty slices between painted ones filled, across `axis` (0, 1, 2). A voxel is
/// filled where the signed distances to the outlines in both neighbouring painted slices sum to 0 or less.
/// Distances are in mm within the slice, negative inside, from voxel to voxel, and weighted by nearness.
/// A connected component of one slice that overlaps none of the other becomes the nearest such component
/// there. It is moved by the difference of the centroids, in whole voxels; the largest component goes first.
/// Painted slices stay as they are. The result is incomplete if cancelled.
BitMask filledBetweenSlices(const BitMask& mask, int axis, const CancelToken& cancel = {});

/// Returns the axis across which slices were painted: there are empty slices between painted ones, and
/// painted slices are fewest (of equal axes the last). Empty if no axis has empty slices between painted
/// ones.
std::optional<int> axisOfPaintedSlices(const BitMask& mask);

}  // namespace volumen
