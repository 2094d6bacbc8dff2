#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "viewer/scene/scene.h"

namespace volumen {

/// Whether plain steps fall in step with what repeats from voxel to voxel, so that all samples of a ray get
/// the same wrong. `alongVoxel`: the ray's unit direction, voxels.
///
/// A pattern that repeats after p voxels is a sum of waves m / p, m in whole numbers by axis; those of a
/// trilinear interpolation fall off with the square of m. A wave of which a step is a whole number of periods
/// cannot be told from a constant: what that gets wrong does not average out. Steps do so, too, that come by
/// the same few places of all cells along an axis.
bool resonates(double stepVoxels, glm::dvec3 alongVoxel);

/// The unit direction of the ray in the middle of the view, voxels: resonance is judged by that one.
glm::dvec3 alongVoxelOf(const Camera& camera, const VoxelGeometry& geometry);

/// The longest step from `least` to `most` voxels that does not resonate, if there is any.
std::optional<double> stepWithoutResonance(glm::dvec3 alongVoxel, double most, double least);

}  // namespace volumen
