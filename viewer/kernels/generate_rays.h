#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "viewer/kernels/ray_row.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// Data shared by all rays of a picture (picture.md 6, 7, 9).
struct ViewRays {
  struct Plane {
    glm::dvec3 normal;  ///< Normal in voxel space; inside is dot(normal, x) <= offset (mm).
    double offset;
  };
  glm::ivec2 size{1};  ///< Size in pixels.
  bool perspective = false, localViewer = false;
  double heightMm = 1;    ///< Height of the picture plane through the target.
  double distanceMm = 0;  ///< Distance from the target to the eye, in perspective.
  CameraAxes axes;        ///< Patient space.
  glm::dvec3 target{0};   ///< Voxel space.
  glm::dmat3 voxelFromMm{1};
  double stepVoxels = 1;
  double sharedStepMm = 1;     ///< Length of a step; 0 in perspective.
  glm::dvec3 low{0}, high{0};  ///< The clipped box in voxel space.
  std::vector<Plane> planes;
  double lengthMm = 0;  ///< Upper bound on the length of a ray inside the box.
  double leastSpacingMm = 1;
};

/// How RayRow::ahead is filled: 0, or steps behind the first ray, rounded to whole steps or exact.
enum class Ahead { none, whole, exact };

/// The part of each ray to sample: from and to in mm from the picture, one entry per ray.
struct RayParts {
  std::vector<double> from, to;
};

/// Computes the rays of row.pixel in double precision; the other arrays of `row` have the same size. Rays
/// that miss the drawn volume and rays without a pixel get no steps. `parts`: null for whole rays.
using GenerateRays = void (*)(const ViewRays&, Ahead, const RayParts* parts, RayRow&);
GenerateRays chooseGenerateRays();

}  // namespace volumen
