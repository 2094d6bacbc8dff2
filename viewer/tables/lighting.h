#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/scene/scene.h"

namespace volumen {

/// One light as picture.md 5 uses it, in patient space, everything that is constant over a picture multiplied
/// in.
struct ShadingLight {
  glm::vec3 l;         ///< unit, towards the light
  glm::vec3 h;         ///< unit, half way between light and viewer; 0 where the light adds nothing to S
  glm::vec3 diffuse;   ///< diffuse * intensity * colour
  glm::vec3 specular;  ///< specular * intensity * colour
  bool operator==(const ShadingLight&) const = default;
};

/// picture.md 5 for one picture: lights, material and the viewer's direction in patient space.
struct Lighting {
  std::vector<ShadingLight> lights;
  glm::vec3 viewer{0};  ///< e, unit (the camera's; with a local viewer each ray has its own)
  float ambient = 1;
  float shininess = 1;
  int wholeShininess = 0;  ///< shininess where it is a whole number up to 256, else 0
  glm::vec3 flat{
      1};  ///< D of a sample whose gradient has no direction: ambient + diffuse/2 * sum(intensity * colour)
  bool twoSided = true;
  bool localViewer = false;
  bool specular = true;  ///< S is evaluated
  bool coloured = true;  ///< else red, green and blue are the same in all of the above
  bool operator==(const Lighting&) const = default;
};

/// The lighting of a complete scene; that of an unlit one gives D = 1, S = 0 for every normal. Lights that
/// are off are left out. `coloured`: what may be said of the lights (Plan::colouredLight).
Lighting makeLighting(const Scene& scene, bool specular, bool coloured);

/// The same with another viewer (a unit vector): of one ray where each has its own.
Lighting seenFrom(Lighting lighting, glm::dvec3 viewer);

/// D'(n) and S'(n) of picture.md 5 for a unit normal, two sides included, in double precision.
struct Shade {
  glm::dvec3 d, s;
};
Shade shadeOf(const Lighting& lighting, glm::dvec3 n);

}  // namespace volumen
