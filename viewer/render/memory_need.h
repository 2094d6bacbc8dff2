#pragma once

#include <cstdint>

#include "viewer/plan/plan.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Returns the bytes needed to draw a plan, without the volume of this grid and type itself: densities,
/// gradients, blocks and pixels.
std::uint64_t bytesToDraw(const Plan& plan, const VoxelGeometry& geometry, const VoxelValues& type);
/// Does the same if only gradients of visible bricks are kept (StoredVoxels::spareGradients).
std::uint64_t leastBytesToDraw(const Plan& plan, const Volume& volume, const VolumeFacts& facts);

}  // namespace volumen
