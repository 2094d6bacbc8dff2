#pragma once

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Returns the step length on a ray along the camera's axis, mm (picture.md 9).
double stepMm(const Camera& camera, const VoxelGeometry& geometry, double stepVoxels);

}  // namespace volumen
