#pragma once

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// picture.md 9: the length of a step on a ray along the camera's axis, mm.
double stepMm(const Camera& camera, const VoxelGeometry& geometry, double stepVoxels);

}  // namespace volumen
