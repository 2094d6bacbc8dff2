#pragma once

#include <algorithm>
#include <vector>

#include "viewer/reference/polynomial.h"
#include "viewer/scene/scene.h"

namespace volumen::reference {

/// The largest component.
inline double largest(glm::dvec3 v) { return std::max({v.x, v.y, v.z}); }

/// picture.md 5 for one direction of view.
class Lighting {
 public:
  /// `axes` turn lights of camera space into patient space; the viewer is at -axes.direction until told.
  Lighting(const Scene& scene, const CameraAxes& axes);
  /// Sets e, the unit vector towards the viewer (patient space).
  void setViewer(glm::dvec3 towardsViewer);

  /// False where the colour of a sample does not depend on the gradient.
  bool directional() const { return floor_ > 0 && !lights_.empty(); }
  /// The shaded colour of a sample with this colour and gradient g_p (value per mm, patient space).
  glm::dvec3 shade(glm::dvec3 colour, glm::dvec3 gradient) const;
  /// Of a surface with this colour where its field has that gradient (picture.md 10).
  glm::dvec3 shadeSurface(glm::dvec3 colour, glm::dvec3 gradient) const;
  /// Appends the s in (0, 1) where the formula changes for a gradient that runs along g.
  void appendKinks(const CubicVector& g, std::vector<double>& places) const;
  /// cos of the angle (about the mean) within which the normals of a piece must lie for its samples not to
  /// miss a highlight or a normal that turns over.
  double smoothCosine() const { return smoothCosine_; }
  /// No component of a shaded colour of 0..1 is larger.
  double brightest() const { return brightest_; }

 private:
  struct Ray {
    glm::dvec3 towards, radiance, halfway;
    bool shines;  ///< false where |l + e| < 1e-3: adds nothing to S
  };
  struct DiffuseSpecular {
    glm::dvec3 d, s;
  };
  DiffuseSpecular at(glm::dvec3 normal) const;
  /// D' and S'.
  DiffuseSpecular onSides(glm::dvec3 normal) const;

  bool lit_, twoSided_;
  double floor_, diffuse_, specular_, shininess_, smoothCosine_, brightest_;
  glm::dvec3 ambient_, flat_, viewer_;
  std::vector<Ray> lights_;
};

}  // namespace volumen::reference
