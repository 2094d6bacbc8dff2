#pragma once

#include "viewer/volume/volume.h"

namespace volumen {

/// The grid of cubes of `factor` voxels along each axis; the last ones of an axis may be smaller.
VoxelGeometry reducedGeometry(const VoxelGeometry& geometry, int factor);

/// A copy whose voxels are the means of such cubes, rounded to the stored type. Padding counts only where a
/// cube holds nothing else. Throws std::bad_alloc.
VolumePtr reducedVolume(const Volume& volume, int factor);

}  // namespace volumen
