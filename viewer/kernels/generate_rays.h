#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "viewer/kernels/ray_row.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// What all rays of a picture share (picture.md 6, 7, 9).
struct ViewRays {
  struct Plane {
    glm::dvec3 normal;  ///< in voxel space: inside where dot(normal, x) <= offset (mm)
    double offset;
  };
  glm::ivec2 size{1};  ///< pixels
  bool perspective = false, localViewer = false;
  double heightMm = 1;    ///< of the picture where it goes through the target
  double distanceMm = 0;  ///< from there to the eye, in perspective
  CameraAxes axes;        ///< patient space
  glm::dvec3 target{0};   ///< voxel space
  glm::dmat3 voxelFromMm{1};
  double stepVoxels = 1;
  double sharedStepMm = 1;     ///< the length of a step; 0 in perspective
  glm::dvec3 low{0}, high{0};  ///< the clipped box, voxel space
  std::vector<Plane> planes;
  double lengthMm = 0;  ///< that no ray is longer inside the box than
  double leastSpacingMm = 1;
};

/// What RayRow::ahead says: nothing (0); steps behind the first ray, whole or not.
enum class Ahead { none, whole, exact };

/// The parts of rays that are looked at: from and to, mm from the picture, one entry a ray.
struct RayParts {
  std::vector<double> from, to;
};

/// Fills in the rays of row.pixel, whose other arrays are as long, in double precision. Rays that miss what
/// is drawn and those of no pixel have no steps. `parts`: null, all of them.
using GenerateRays = void (*)(const ViewRays&, Ahead, const RayParts* parts, RayRow&);
GenerateRays chooseGenerateRays();

}  // namespace volumen
