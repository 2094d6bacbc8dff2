#pragma once

#include "viewer/scene/scene.h"

namespace volumen {

struct VolumeFacts;

/// Bounds, over all values of a volume, on what a curve makes of them.
struct Steepness {
  double perMm = 0;   ///< largest extinction, 1/mm
  double change = 0;  ///< how much extinction, and colour times extinction, can change from voxel to voxel:
                      ///< 1/mm a voxel; infinity where the curve jumps or is opaque
};
Steepness steepnessOf(const TransferFunction& curve, const VolumeFacts& facts);

}  // namespace volumen
