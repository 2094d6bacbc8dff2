#pragma once

#include "viewer/volume/volume.h"

namespace volumen {

/// Makes a synthetic contrast-enhanced CT of a head in HU, as int16. It has `sizeInPlane` x `sizeInPlane`
/// voxels over 240 mm. Slices cover 260 mm and are no thicker than 1.25 mm or the voxels' width, whichever is
/// larger. The bytes do not depend on the number of threads. Structures: viewer/phantoms/head.
VolumeParts headPhantom(int sizeInPlane);

/// Makes the same phantom from values computed by an earlier call.
VolumeParts headPhantom(int sizeInPlane, std::vector<std::int16_t> values);

/// Returns true if `values` are those of headPhantom(sizeInPlane). Checks one in 211 blocks; values of
/// another program version differ in many.
bool areHeadPhantoms(int sizeInPlane, const std::vector<std::int16_t>& values);

/// Returns the phantom's voxel geometry alone.
VoxelGeometry headGeometry(int sizeInPlane);

}  // namespace volumen
