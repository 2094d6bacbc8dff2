#pragma once

#include <algorithm>
#include <vector>

#include "viewer/reference/polynomial.h"
#include "viewer/scene/scene.h"

namespace volumen::reference {

/// Returns the largest component.
inline double largest(glm::dvec3 v) { return std::max({v.x, v.y, v.z}); }

/// The lighting of picture.md 5 for one direction of view.
class Lighting {
 public:
  /// `axes` map lights from camera space to patient space. The viewer is at -axes.direction until
  /// setViewer().
  Lighting(const Scene& scene, const CameraAxes& axes);
  /// Sets e, the unit vector towards the viewer (patient space).
  void setViewer(glm::dvec3 towardsViewer);

  /// Returns false if the colour of a sample does not depend on the gradient.
  bool directional() const { return floor_ > 0 && !lights_.empty(); }
  /// Returns the shaded colour of a sample with this colour and gradient g_p (value per mm, patient space).
  glm::dvec3 shade(glm::dvec3 colour, glm::dvec3 gradient) const;
  /// Returns the shaded colour of a surface with this colour where its field has this gradient (picture.md
  /// 10).
  glm::dvec3 shadeSurface(glm::dvec3 colour, glm::dvec3 gradient) const;
  /// Appends the s in (0, 1) where the formula changes for a gradient that varies as g(s).
  void appendKinks(const CubicVector& g, std::vector<double>& places) const;
  /// Returns the cosine of the largest angle between the normals of a piece and their mean. Within it the
  /// samples miss neither a highlight nor a normal that turns over.
  double smoothCosine() const { return smoothCosine_; }
  /// Returns an upper bound on the components of shaded colours of 0..1.
  double brightest() const { return brightest_; }

 private:
  struct Ray {
    glm::dvec3 towards, radiance, halfway;
    bool shines;  ///< False where |l + e| < 1e-3: the light adds nothing to S.
  };
  struct DiffuseSpecular {
    glm::dvec3 d, s;
  };
  DiffuseSpecular at(glm::dvec3 normal) const;
  /// Returns D' and S'.
  DiffuseSpecular onSides(glm::dvec3 normal) const;

  bool lit_, twoSided_;
  double floor_, diffuse_, specular_, shininess_, smoothCosine_, brightest_;
  glm::dvec3 ambient_, flat_, viewer_;
  std::vector<Ray> lights_;
};

}  // namespace volumen::reference
