#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "viewer/scene/scene.h"

namespace volumen {

// Plain steps resonate with patterns that repeat every few voxels if all samples of a ray share the same
// error. A pattern with a period of p voxels is a sum of waves m / p, with integers m per axis. Those of
// trilinear interpolation decay with the square of m. A wave with a whole number of periods per step looks
// constant, and its error does not average out. The same holds for steps that meet all cells along an axis at
// the same few places.

/// Returns the unit direction of the central ray in voxels, which is used to judge resonance.
glm::dvec3 alongVoxelOf(const Camera& camera, const VoxelGeometry& geometry);

/// Returns the step of least resonance from `least` to `most` voxels, or the longest that has next to none.
/// `alongVoxel` is the ray's unit direction in voxels. Empty if all of them resonate.
std::optional<double> stepWithoutResonance(glm::dvec3 alongVoxel, double most, double least);

/// Returns the longest step from `least` to `most` voxels that a pilot may try: its samples spread evenly
/// over the cells, and it resonates little. Empty if there is none.
std::optional<double> evenlySpreadStep(glm::dvec3 alongVoxel, double most, double least);

}  // namespace volumen
