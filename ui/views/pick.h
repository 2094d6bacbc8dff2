#pragma once

#include <optional>

#include "ui/workspace/camera_moves.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// What is seen along a line of sight.
struct Pick {
  std::optional<glm::dvec3> pPatient;  ///< where, mm; none where the whole line is shown, as in `average`
  double value = 0;                    ///< there, real units; else what is made of the line
  std::optional<double>
      softMm{}; /**< of the line from a quarter of its final opacity to three quarters; none
                   but of a composite scene: projections do not show how deep a place lies */
  std::optional<std::size_t> segment{};  ///< whose surface it is, of the scene's; none: the volume is seen
};

/// Looks along the line through box, clip and curve, gradient opacity included, and surfaces of segments, as
/// the picture does. Of a composite scene: the place at which half of the line's final opacity is reached,
/// whose value the curve shows, or on a segment; none where less than a twentieth of the light is stopped.
/// `mip`, `minip`: where the largest or
/// smallest value lies. A few steps a voxel, on the calling thread.
std::optional<Pick> pick(const Scene& scene, const Volume& volume, const SightLine& line, bool parallel);

/// v(x) of picture.md 2 at a voxel position, real units.
double valueAtVoxel(const Volume& volume, glm::dvec3 pVoxel);

}  // namespace volumen
