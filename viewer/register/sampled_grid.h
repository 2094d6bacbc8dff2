#pragma once

#include "viewer/volume/cancel.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// A volume on a coarser grid with the same axes: means over blocks of values clamped to P0.1 .. P99.9.
struct SampledGrid {
  VoxelGeometry geometry;
  std::vector<float> values;
};

/// Averages blocks of about `mm`, at least one voxel, larger where an axis would have more than `most`
/// blocks. Incomplete blocks at the far ends are dropped. The result is undefined if cancelled.
SampledGrid sampledGrid(const Volume& volume, double mm, int most, const CancelToken& cancel);

}  // namespace volumen
