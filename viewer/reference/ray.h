#pragma once

#include <cmath>

#include "viewer/scene/scene.h"

namespace volumen::reference {

/// A straight line in patient space, with t in mm along the unit direction. Only t >= nearMm is visible.
struct Ray {
  glm::dvec3 origin, direction;
  double nearMm;
};

/// The part of a ray to integrate: t from t0 to t1, mm. Empty if t1 <= t0, or if inputs were so large that
/// the result is not finite.
struct Interval {
  double t0, t1;
  bool empty() const { return !(t1 > t0 && std::isfinite(t1 - t0)); }
};

/// Makes the rays of a picture (picture.md 7).
class RayMaker {
 public:
  RayMaker(const Camera& camera, const VoxelGeometry& geometry, glm::ivec2 size);
  /// Returns the ray through the centre of pixel (px, py), with py downwards. Its origin is the point q of
  /// picture.md 7, not the eye, so that a distant eye costs no precision.
  Ray through(int px, int py) const;
  const CameraAxes& axes() const { return axes_; }

 private:
  CameraAxes axes_;
  glm::dvec3 target_;
  glm::ivec2 size_;
  bool perspective_;
  double distanceMm_, heightMm_;
};

/// Returns the part of the ray inside the volume's box, the clip box and the clip planes, and in front of the
/// eye (picture.md 6).
Interval visibleInterval(const Ray& ray, const VoxelGeometry& geometry, const Clip& clip);

/// Returns the part of the ray where surfaces are visible (picture.md 10). It is visibleInterval()
/// without those sides of the clip box that are the volume's own, and may be infinite. Empty if the clip box
/// is empty.
Interval surfaceInterval(const Ray& ray, const VoxelGeometry& geometry, const Clip& clip);

}  // namespace volumen::reference
