#pragma once

#include <cstdint>
#include <span>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Voxels whose ball of radiusMm (morphology.h) holds more voxels of the mask than others; of as many, as it
/// was. Voxels beyond the grid are not counted. A cancelled one is returned half done.
BitMask medianSmoothed(const BitMask& mask, double radiusMm, const CancelToken& cancel = {});
/// Voxels where the occupancy (1 inside, 0 outside; beyond the grid as at its border) after a Gaussian of
/// sigmaMm in patient space, sampled at voxels and cut at 4 sigmaMm, is at least 1/2. On sheared grids too. A
/// cancelled one is returned half done.
BitMask gaussianSmoothed(const BitMask& mask, double sigmaMm, const CancelToken& cancel = {});
/// All labels at once, without gaps: each voxel takes the label (background too) whose occupancy after that
/// Gaussian is largest; of as large ones its own if it is among them, else the smallest. Locked labels
/// neither gain nor lose. Bricks that stay the same are shared. A cancelled one is returned half done.
LabelMap jointSmoothed(const LabelMap& map, double sigmaMm, std::span<const std::uint8_t> locked = {},
                       const CancelToken& cancel = {});

}  // namespace volumen
