#pragma once

#include "viewer/volume/volume.h"

namespace volumen {

/// A synthetic contrast-enhanced CT of a head in HU, int16: `sizeInPlane` x `sizeInPlane` voxels over 240 mm,
/// slices over 260 mm no thicker than 1.25 mm or the voxels' width, whichever is more. The same bytes for any
/// number of threads. Structures: viewer/volume/head.
VolumeParts headPhantom(int sizeInPlane);

/// Its voxels alone.
VoxelGeometry headGeometry(int sizeInPlane);

}  // namespace volumen
