#pragma once

#include "viewer/scene/scene.h"

namespace volumen {

/// From where a volume is seen that nobody has chosen a camera for, not fitted yet: from the front; a volume
/// of few slices, or one much thinner than wide, along the normal of its slices, upright as its pictures are
/// read (from below, the front or the left).
Camera firstCamera(const VoxelGeometry& geometry);

}  // namespace volumen
