#pragma once

#include <vector>

#include "viewer/reference/lighting.h"
#include "viewer/reference/ray.h"

namespace volumen::reference {

/// A point where a ray meets the surface of a segment, and the surface's appearance there.
struct SurfaceCrossing {
  double t;  ///< Distance along the ray, mm.
  glm::dvec3 colour;
  double opacity;
};

/// The segments of a scene (picture.md 10).
class Surfaces {
 public:
  Surfaces(const Scene& scene, const VoxelGeometry& geometry);
  /// Returns all crossings along a ray, in the order of picture.md 10.
  std::vector<SurfaceCrossing> along(const Ray& ray, const Lighting& lighting) const;

 private:
  const Scene& scene_;
  const VoxelGeometry& geometry_;
  std::vector<const SegmentSurface*> shown_;
};

}  // namespace volumen::reference
