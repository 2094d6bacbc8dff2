#pragma once

#include <optional>

#include "ui/session/camera_moves.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// What is seen along a line of sight.
struct Pick {
  glm::dvec3 pPatient{0};  ///< at the mean depth of what is seen, weighted by opacity; mm
  double value = 0;        ///< there, real units
};

/// Looks along the line in steps of half a voxel, through clip and curve (shading changes no depth). None
/// where less than a twentieth of the light is stopped. A composite scene's; `mip`: at the largest value.
std::optional<Pick> pick(const Scene& scene, const Volume& volume, const SightLine& line, bool parallel);

/// v(x) of SCENE 2 at a voxel position, real units.
double valueAtVoxel(const Volume& volume, glm::dvec3 pVoxel);

}  // namespace volumen
