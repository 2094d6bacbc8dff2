#pragma once

#include <vector>

#include "viewer/slice/plane.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/rigid.h"

namespace volumen {

/// A grid to resample a volume on.
struct PlacedGrid {
  VoxelGeometry geometry;
  Rigid volumeFromGrid{};  ///< from the grid's patient space to that of the volume
  Interpolation interpolation = Interpolation::linear;
};

/// Resamples a volume at the voxel centres of slice `k` of a grid, i fastest; NaN outside the volume's box.
/// Interpolation and rounding are those of resampleSlice(): at its own voxels a volume keeps its values. The
/// Error means: cancelled.
Result<std::vector<float>> resampleGridSlice(const Volume& volume, const PlacedGrid& grid, int k,
                                             const CancelToken& cancel = {});

}  // namespace volumen
