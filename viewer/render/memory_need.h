#pragma once

#include <cstdint>

#include "viewer/plan/plan.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Bytes that drawing a plan takes beside a volume of this grid and type: densities, gradients, blocks,
/// pixels.
std::uint64_t bytesToDraw(const Plan& plan, const VoxelGeometry& geometry, const VoxelValues& type);
/// The same of a volume whose gradients may be kept of bricks alone (StoredVoxels::spareGradients).
std::uint64_t leastBytesToDraw(const Plan& plan, const Volume& volume, const VolumeFacts& facts);

}  // namespace volumen
