#pragma once

#include "viewer/volume/volume.h"

namespace volumen {

/// Returns the grid whose voxels are cubes of `factor` voxels along each axis. The last cube of an axis may
/// be smaller.
VoxelGeometry reducedGeometry(const VoxelGeometry& geometry, int factor);

/// Returns a copy whose voxels are the means of these cubes, rounded to the stored type. A mean ignores
/// padding unless the cube holds nothing else. Throws std::bad_alloc.
VolumePtr reducedVolume(const Volume& volume, int factor);

}  // namespace volumen
