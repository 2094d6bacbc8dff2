#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "viewer/scene/scene.h"

namespace volumen {

/// How far plain steps fall in step with patterns of two to four voxels, as a share of all that such steps
/// have wrong: 1 and above is the most. `alongVoxel`: the ray's unit direction, voxels.
///
/// A pattern that repeats after p voxels is a sum of waves m / p, m in whole numbers by axis; those of a
/// trilinear interpolation fall off with the square of m. A wave of which a step is a whole number of periods
/// cannot be told from a constant: what that gets wrong is the same in all samples of a ray, and adds up.
double resonance(double stepVoxels, glm::dvec3 alongVoxel);

/// The unit direction of the ray in the middle of the view, voxels: resonance is judged by that one.
glm::dvec3 alongVoxelOf(const Camera& camera, const VoxelGeometry& geometry);

/// The longest step from `least` to `most` voxels that hardly resonates along the ray, if there is any.
std::optional<double> stepWithoutResonance(glm::dvec3 alongVoxel, double most, double least);

}  // namespace volumen
