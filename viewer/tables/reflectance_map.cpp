#include "viewer/tables/reflectance_map.h"

namespace volumen {

Lighting mapInputs(Lighting lighting) {
  lighting.flat = glm::vec3(0);
  if (!lighting.twoSided) lighting.viewer = glm::vec3(0);
  if (lighting.specular) return lighting;
  lighting.shininess = 1;
  lighting.wholeShininess = 0;
  for (ShadingLight& light : lighting.lights) light.h = light.specular = glm::vec3(0);
  return lighting;
}

}  // namespace volumen
