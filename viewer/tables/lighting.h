#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/scene/scene.h"

namespace volumen {

/// One light as picture.md 5 uses it, in patient space, multiplied by everything that is constant over a
/// picture.
struct ShadingLight {
  glm::vec3 l;         ///< Unit vector towards the light.
  glm::vec3 h;         ///< Unit vector half way between light and viewer; 0 if the light adds nothing to S.
  glm::vec3 diffuse;   ///< diffuse * intensity * colour.
  glm::vec3 specular;  ///< specular * intensity * colour.
  bool operator==(const ShadingLight&) const = default;
};

/// The lighting of picture.md 5 for one picture: lights, material and the viewer's direction in patient
/// space.
struct Lighting {
  std::vector<ShadingLight> lights;
  glm::vec3 viewer{0};  ///< Unit vector e of the camera. With a local viewer each ray has its own.
  float ambient = 1;
  float shininess = 1;
  int wholeShininess = 0;  ///< Shininess if it is a whole number up to 256, else 0.
  glm::vec3 flat{
      1};  ///< D of a sample whose gradient has no direction: ambient + diffuse/2 * sum(intensity * colour).
  bool twoSided = true;
  bool localViewer = false;
  bool specular = true;  ///< True if S is evaluated.
  bool coloured = true;  ///< False if red, green and blue are equal in all of the above.
  bool operator==(const Lighting&) const = default;
};

/// Returns the lighting of a complete scene. For an unlit scene D = 1 and S = 0 for every normal. Lights that
/// are off are left out. `coloured`: whether lights may be coloured (Plan::colouredLight).
Lighting makeLighting(const Scene& scene, bool specular, bool coloured);

/// Returns the lighting for another viewer (a unit vector), e.g. that of a ray with its own viewer.
Lighting seenFrom(Lighting lighting, glm::dvec3 viewer);

/// D'(n) and S'(n) of picture.md 5 for a unit normal, including both sides, in double precision.
struct Shade {
  glm::dvec3 d, s;
};
Shade shadeOf(const Lighting& lighting, glm::dvec3 n);

}  // namespace volumen
