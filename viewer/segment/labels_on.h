#pragma once

#include "viewer/segment/label_map.h"

namespace volumen {

/// A label map on another grid: each voxel has the label of the voxel that holds its centre; background where
/// none does. On all cores.
LabelMap labelsOn(const LabelMap& map, const VoxelGeometry& grid);

/// Whether each voxel of one grid lies nearest to the same voxel of the other, so that labels stay as they
/// are.
bool areSameVoxels(const VoxelGeometry& a, const VoxelGeometry& b);

}  // namespace volumen
