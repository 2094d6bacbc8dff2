#pragma once

#include "viewer/segment/label_map.h"

namespace volumen {

/// Resamples a label map to another grid by nearest neighbour; background outside the map. Runs on all cores.
LabelMap labelsOn(const LabelMap& map, const VoxelGeometry& grid);

/// Returns whether each voxel of grid `a` lies nearest to the voxel of `b` with the same index, so that
/// labels need no resampling.
bool areSameVoxels(const VoxelGeometry& a, const VoxelGeometry& b);

}  // namespace volumen
