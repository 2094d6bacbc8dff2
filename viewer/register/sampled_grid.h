#pragma once

#include "viewer/volume/cancel.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// A volume on a coarser grid of the same directions: means over blocks, limited to the values between
/// P0.1 and P99.9.
struct SampledGrid {
  VoxelGeometry geometry;
  std::vector<float> values;
};

/// Blocks of about `mm`, never smaller than a voxel, and larger where an axis would have more than `most`.
/// Parts of blocks at the far ends are left out. Nothing of meaning where it was cancelled.
SampledGrid sampledGrid(const Volume& volume, double mm, int most, const CancelToken& cancel);

}  // namespace volumen
