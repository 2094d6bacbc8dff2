#pragma once

#include "viewer/scene/scene.h"

namespace volumen {

/// Returns the initial camera of a volume, not fitted yet: from the front. Volumes with few slices, or much
/// thinner than wide, are seen along their slice normal, upright as their images are read (from below, the
/// front or the left).
Camera firstCamera(const VoxelGeometry& geometry);

}  // namespace volumen
