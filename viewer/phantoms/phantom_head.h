#pragma once

#include "viewer/volume/volume.h"

namespace volumen {

/// A synthetic contrast-enhanced CT of a head in HU, int16: `sizeInPlane` x `sizeInPlane` voxels over 240 mm,
/// slices over 260 mm no thicker than 1.25 mm or the voxels' width, whichever is more. The same bytes for any
/// number of threads. Structures: viewer/volume/head.
VolumeParts headPhantom(int sizeInPlane);

/// The same of values that it gave before.
VolumeParts headPhantom(int sizeInPlane, std::vector<std::int16_t> values);

/// Whether `values` are those of headPhantom(sizeInPlane), as far as one of 211 blocks tells: what another
/// version of the program made differs in many.
bool areHeadPhantoms(int sizeInPlane, const std::vector<std::int16_t>& values);

/// Its voxels alone.
VoxelGeometry headGeometry(int sizeInPlane);

}  // namespace volumen
