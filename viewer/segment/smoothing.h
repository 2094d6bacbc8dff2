#pragma once

#include <cstdint>
#include <span>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Median filter: keeps voxels whose ball of `radiusMm` (morphology.h) holds more voxels of the mask than
/// others; ties leave the voxel unchanged. Voxels beyond the grid are not counted. The result is incomplete
/// if cancelled.
BitMask medianSmoothed(const BitMask& mask, double radiusMm, const CancelToken& cancel = {});
/// Gaussian filter: keeps voxels where the smoothed mask (1 inside, 0 outside, border values continued) is at
/// least 1/2. The kernel has `sigmaMm` in patient space and is cut at 4 sigmaMm, on sheared grids too. The
/// result is incomplete if cancelled.
BitMask gaussianSmoothed(const BitMask& mask, double sigmaMm, const CancelToken& cancel = {});
/// Smooths all labels together, without gaps: each voxel takes the label (background too) with the largest
/// smoothed mask. Of equal ones its own label wins if it is among them, else the smallest. Locked labels
/// neither gain nor lose voxels. Unchanged bricks are shared. The result is incomplete if cancelled.
LabelMap jointSmoothed(const LabelMap& map, double sigmaMm, std::span<const std::uint8_t> locked = {},
                       const CancelToken& cancel = {});

}  // namespace volumen
