#pragma once

#include "viewer/segment/bit_mask.h"

namespace volumen {

/// Adds the voxels whose centre lies within radiusMm of the line between two places of the patient (mm).
void addCapsule(BitMask& mask, glm::dvec3 from, glm::dvec3 to, double radiusMm);

}  // namespace volumen
