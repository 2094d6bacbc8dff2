#pragma once

#include "viewer/scene/scene.h"

namespace volumen {

struct VolumeFacts;

/// Bounds on the extinction and colour of a curve over all values of a volume.
struct Steepness {
  double perMm = 0;  ///< Largest extinction, 1/mm
  /// Largest change of extinction, or colour times extinction, from voxel to voxel, in 1/mm per voxel.
  /// Infinity where the curve jumps or is opaque.
  double change = 0;
};
Steepness steepnessOf(const TransferFunction& curve, const VolumeFacts& facts);

/// Returns how often the opacity or a colour of the curve turns from rising to falling or back; the largest
/// number of the four.
int turnsOf(const TransferFunction& curve);

}  // namespace volumen
