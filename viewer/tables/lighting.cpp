#include "viewer/tables/lighting.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace volumen {

namespace {

// Limits a strength so that products of strengths stay within the range of floats. The picture is white long
// before.
double limited(double strength) { return std::min(strength, 1e12); }

// Returns the half-way vector; a light exactly behind has none (picture.md 5).
glm::dvec3 halfWay(glm::dvec3 light, glm::dvec3 viewer) {
  const glm::dvec3 both = light + viewer;
  return glm::length(both) < 1e-3 ? glm::dvec3(0) : glm::normalize(both);
}

}  // namespace

Lighting makeLighting(const Scene& scene, bool specular, bool coloured) {
  Lighting out;
  out.specular = specular;
  out.coloured = coloured;
  const CameraAxes axes = cameraAxes(*scene.camera);
  const glm::dvec3 viewer = -axes.direction;
  out.viewer = viewer;
  const Shading& s = scene.shading;
  out.twoSided = s.sides == 2;
  out.localViewer = s.localViewer;
  if (!s.lit) return out;
  const double diffuse = limited(s.diffuse), specularity = limited(s.specular);
  out.ambient = float(limited(s.ambient));
  out.shininess = float(s.shininess);
  if (s.shininess <= 256 && s.shininess == std::floor(s.shininess)) out.wholeShininess = int(s.shininess);
  glm::dvec3 sum(0);
  for (const Light& light : scene.lights) {
    if (!light.on) continue;
    const glm::dvec3 c = limited(light.intensity) * light.colour;
    const glm::dvec3 size = glm::abs(light.direction);
    const glm::dvec3 p = light.direction / std::max({size.x, size.y, size.z});
    const glm::dvec3 l =
        glm::normalize(light.space == Space::patient ? p : p.x * axes.right + p.y * axes.up + p.z * viewer);
    out.lights.push_back({l, halfWay(l, viewer), diffuse * c, specularity * c});
    sum += c;
  }
  out.flat = glm::dvec3(limited(s.ambient)) + diffuse / 2 * sum;
  return out;
}

Lighting seenFrom(Lighting lighting, glm::dvec3 viewer) {
  lighting.viewer = viewer;
  for (ShadingLight& light : lighting.lights) light.h = halfWay(light.l, viewer);
  return lighting;
}

namespace {

Shade oneSide(const Lighting& lighting, glm::dvec3 n) {
  Shade out{glm::dvec3(lighting.ambient), glm::dvec3(0)};
  for (const ShadingLight& light : lighting.lights) {
    const double nl = glm::dot(n, glm::dvec3(light.l)), nh = glm::dot(n, glm::dvec3(light.h));
    out.d += glm::dvec3(light.diffuse) * std::max(0.0, nl);
    if (lighting.specular && nh > 0)
      out.s += glm::dvec3(light.specular) * std::clamp(10 * nl, 0.0, 1.0) *
               std::pow(nh, double(lighting.shininess));
  }
  return out;
}

}  // namespace

Shade shadeOf(const Lighting& lighting, glm::dvec3 n) {
  const Shade front = oneSide(lighting, n);
  if (!lighting.twoSided) return front;
  const Shade back = oneSide(lighting, -n);
  const double w = std::clamp(0.5 + glm::dot(n, glm::dvec3(lighting.viewer)) / 0.2, 0.0, 1.0);
  return {back.d + w * (front.d - back.d), back.s + w * (front.s - back.s)};
}

}  // namespace volumen
