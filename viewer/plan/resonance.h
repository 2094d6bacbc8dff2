#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "viewer/scene/scene.h"

namespace volumen {

/// Returns whether plain steps resonate with patterns that repeat from voxel to voxel, so that all samples of
/// a ray share the same error. `alongVoxel` is the ray's unit direction in voxels.
/// A pattern with a period of p voxels is a sum of waves m / p, with integers m per axis. Those of trilinear
/// interpolation decay with the square of m. A wave with a whole number of periods per step looks constant,
/// and its error does not average out. The same holds for steps that meet all cells along an axis at the same
/// few places.
bool resonates(double stepVoxels, glm::dvec3 alongVoxel);

/// Returns the unit direction of the central ray in voxels, which is used to judge resonance.
glm::dvec3 alongVoxelOf(const Camera& camera, const VoxelGeometry& geometry);

/// Returns the longest step from `least` to `most` voxels that does not resonate; empty if there is none.
std::optional<double> stepWithoutResonance(glm::dvec3 alongVoxel, double most, double least);

}  // namespace volumen
