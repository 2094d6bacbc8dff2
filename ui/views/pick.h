#pragma once

#include <optional>

#include "ui/workspace/camera_moves.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// The point or value seen along a line of sight.
struct Pick {
  /// Patient mm; empty if the whole line is shown, as in `average`.
  std::optional<glm::dvec3> pPatient;
  double value = 0;  ///< at `pPatient`, else the value of the projection; real units
  /// Length of the line from a quarter of its final opacity to three quarters, mm. Only in composite scenes,
  /// because projections do not show depth.
  std::optional<double> softMm{};
  std::optional<std::size_t> segment{};  ///< index of the scene's segment; empty if the volume is seen
};

/// Returns what the picture shows along a line: box, clip, transfer function, gradient opacity and segment
/// surfaces all count. In a composite scene it is the point where half of the line's final opacity is
/// reached, with a value that the curve shows, or on a segment. It returns nothing if less than 5 % of the
/// light is stopped. In `mip` and `minip` it is the point of the largest or smallest value. Takes a few steps
/// per voxel on the calling thread.
std::optional<Pick> pick(const Scene& scene, const Volume& volume, const SightLine& line, bool parallel);

/// v(x) of picture.md 2 at a voxel position, real units.
double valueAtVoxel(const Volume& volume, glm::dvec3 pVoxel);

}  // namespace volumen
