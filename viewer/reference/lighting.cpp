#include "viewer/reference/lighting.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace volumen::reference {

namespace {
constexpr double viewerBand = 0.1;  // w of picture.md 5 runs from 0 to 1 over |n.e| <= 0.1.
constexpr double lightBand = 0.1;   // clamp(10 n.l) runs from 0 to 1 over 0 <= n.l <= 0.1.
// Limits a strength so that no product of strengths is infinite. The picture is white long before.
double limited(double strength) { return std::min(strength, 1e30); }
}  // namespace

Lighting::Lighting(const Scene& scene, const CameraAxes& axes)
    : lit_(scene.shading.lit),
      twoSided_(scene.shading.sides == 2),
      floor_(lit_ ? scene.shading.gradientFloor.value_or(0) : 0),
      diffuse_(limited(scene.shading.diffuse)),
      specular_(limited(scene.shading.specular)),
      shininess_(scene.shading.shininess),
      smoothCosine_(std::cos(specular_ > 0 ? std::min(0.3, 1 / std::sqrt(shininess_)) : 0.3)),
      ambient_(limited(scene.shading.ambient)),
      flat_(ambient_) {
  glm::dvec3 sum(0);
  for (const Light& light : scene.lights) {
    if (!light.on) continue;
    const glm::dvec3 d = light.direction / largest(glm::abs(light.direction));
    const glm::dvec3 l =
        light.space == Space::patient ? d : d.x * axes.right + d.y * axes.up - d.z * axes.direction;
    lights_.push_back({glm::normalize(l), limited(light.intensity) * light.colour, {}, false});
    sum += lights_.back().radiance;
  }
  flat_ += diffuse_ / 2 * sum;
  brightest_ = lit_ ? std::max(1.0, largest(ambient_ + (diffuse_ + specular_) * sum)) : 1;
  setViewer(-axes.direction);
}

void Lighting::setViewer(glm::dvec3 towardsViewer) {
  viewer_ = towardsViewer;
  for (Ray& light : lights_) {
    const glm::dvec3 sum = light.towards + viewer_;
    light.shines = specular_ > 0 && glm::length(sum) >= 1e-3;
    if (light.shines) light.halfway = glm::normalize(sum);
  }
}

Lighting::DiffuseSpecular Lighting::at(glm::dvec3 normal) const {
  DiffuseSpecular sum{ambient_, glm::dvec3(0)};
  for (const Ray& light : lights_) {
    const double nl = glm::dot(normal, light.towards);
    if (nl <= 0) continue;
    sum.d += diffuse_ * nl * light.radiance;
    if (!light.shines) continue;
    const double nh = std::max(0.0, glm::dot(normal, light.halfway));
    sum.s += specular_ * std::min(nl / lightBand, 1.0) * std::pow(nh, shininess_) * light.radiance;
  }
  return sum;
}

Lighting::DiffuseSpecular Lighting::onSides(glm::dvec3 n) const {
  const double w = twoSided_ ? std::clamp(0.5 + glm::dot(n, viewer_) / (2 * viewerBand), 0.0, 1.0) : 1;
  DiffuseSpecular sum{glm::dvec3(0), glm::dvec3(0)};
  const auto addSide = [&](double weight, glm::dvec3 normal) {
    if (weight == 0) return;
    const DiffuseSpecular side = at(normal);
    sum.d += weight * side.d;
    sum.s += weight * side.s;
  };
  addSide(w, n);
  addSide(1 - w, -n);
  return sum;
}

glm::dvec3 Lighting::shade(glm::dvec3 colour, glm::dvec3 gradient) const {
  if (!lit_) return colour;
  const double length = glm::length(gradient);
  if (!directional() || length == 0) return colour * flat_;
  const double q = std::min(1.0, length / floor_);
  const DiffuseSpecular light = onSides(-gradient / length);
  return colour * (q * light.d + (1 - q) * flat_) + q * light.s;
}

glm::dvec3 Lighting::shadeSurface(glm::dvec3 colour, glm::dvec3 gradient) const {
  if (!lit_) return colour;
  const double length = glm::length(gradient);
  if (length == 0) return colour * flat_;
  const DiffuseSpecular light = onSides(-gradient / length);
  return colour * light.d + light.s;
}

void Lighting::appendKinks(const CubicVector& g, std::vector<double>& places) const {
  const Sextic length2 = squared(g);
  // Appends where |g . direction| = band |g|.
  const auto appendBand = [&](const Cubic& along, double band) {
    appendSignChanges(sum(squared(along), -band * band, length2), places);
  };
  Sextic aboveFloor = length2;
  aboveFloor.c[0] -= floor_ * floor_;
  appendSignChanges(aboveFloor, places);
  if (twoSided_) appendBand(dot(g, viewer_), viewerBand);
  for (const Ray& light : lights_) {
    const Cubic along = dot(g, light.towards);
    appendSignChanges(along, places);
    if (!light.shines) continue;
    appendBand(along, lightBand);
    appendSignChanges(dot(g, light.halfway), places);
  }
}

}  // namespace volumen::reference
