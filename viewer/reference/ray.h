#pragma once

#include <cmath>

#include "viewer/scene/scene.h"

namespace volumen::reference {

/// A straight line in patient space, t in mm along the unit direction; only t >= nearMm is seen.
struct Ray {
  glm::dvec3 origin, direction;
  double nearMm;
};

/// The part of a ray that is integrated: t from t0 to t1, mm. Empty where t1 <= t0, or where numbers so large
/// went in that it is not known.
struct Interval {
  double t0, t1;
  bool empty() const { return !(t1 > t0 && std::isfinite(t1 - t0)); }
};

/// picture.md 7: the rays of a picture.
class RayMaker {
 public:
  RayMaker(const Camera& camera, const VoxelGeometry& geometry, glm::ivec2 size);
  /// The ray through the centre of pixel (px, py), py downwards. Its origin is the point q of picture.md 7,
  /// not the eye, so that a distant eye costs no precision.
  Ray through(int px, int py) const;
  const CameraAxes& axes() const { return axes_; }

 private:
  CameraAxes axes_;
  glm::dvec3 target_;
  glm::ivec2 size_;
  bool perspective_;
  double distanceMm_, heightMm_;
};

/// picture.md 6: the ray inside the volume's box, the clip box and the clip planes, and in front of the eye.
Interval visibleInterval(const Ray& ray, const VoxelGeometry& geometry, const Clip& clip);

/// picture.md 10: where surfaces are seen. The same without the sides of the clip box that are the volume's
/// own; empty where the clip box is. It may be without end.
Interval surfaceInterval(const Ray& ray, const VoxelGeometry& geometry, const Clip& clip);

}  // namespace volumen::reference
