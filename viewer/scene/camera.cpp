#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "viewer/scene/scene.h"

namespace volumen {

namespace {

struct View {
  const char* name;
  glm::dvec3 direction, up;
};

constexpr View views[] = {
    {"anterior", {0, 1, 0}, {0, 0, 1}},   {"posterior", {0, -1, 0}, {0, 0, 1}},
    {"left", {-1, 0, 0}, {0, 0, 1}},      {"right", {1, 0, 0}, {0, 0, 1}},
    {"superior", {0, 0, -1}, {0, -1, 0}}, {"inferior", {0, 0, 1}, {0, -1, 0}},
};

// Rotates v around a unit axis (Rodrigues).
glm::dvec3 rotated(glm::dvec3 v, glm::dvec3 axis, double angleRad) {
  return v * std::cos(angleRad) + glm::cross(axis, v) * std::sin(angleRad) +
         axis * glm::dot(axis, v) * (1 - std::cos(angleRad));
}

}  // namespace

std::optional<Camera> standardView(const std::string& name) {
  for (const View& v : views) {
    if (name != v.name) continue;
    Camera camera;
    camera.direction = v.direction;
    camera.up = v.up;
    return camera;
  }
  return {};
}

const std::vector<std::string>& standardViewNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const View& v : views) all.push_back(v.name);
    return all;
  }();
  return names;
}

CameraAxes cameraAxes(const Camera& camera) {
  const glm::dvec3 d = glm::normalize(camera.direction);
  const glm::dvec3 right = glm::normalize(glm::cross(d, camera.up));
  return {right, glm::cross(right, d), d};
}

Camera fitCamera(Camera camera, const VoxelGeometry& geometry, double aspect) {
  if (!camera.target) camera.target = geometry.centre();
  const CameraAxes axes = cameraAxes(camera);
  const double halfTan = std::tan(glm::radians(camera.fov) / 2);
  double halfHeight = 0, distance = 0;
  for (const glm::dvec3& corner : geometry.boxCorners()) {
    const glm::dvec3 q = corner - *camera.target;
    const double half = std::max(std::abs(glm::dot(q, axes.up)), std::abs(glm::dot(q, axes.right)) / aspect);
    halfHeight = std::max(halfHeight, half);
    distance = std::max(distance, half / halfTan - glm::dot(q, axes.direction));
  }
  camera.height = 2 * halfHeight;
  camera.distance = distance;
  return camera;
}

Camera turned(Camera camera, double degrees) {
  camera.direction =
      rotated(glm::normalize(camera.direction), glm::normalize(camera.up), glm::radians(degrees));
  return camera;
}

Camera elevated(Camera camera, double degrees) {
  const CameraAxes axes = cameraAxes(camera);
  const glm::dvec3 up = glm::normalize(camera.up);
  const glm::dvec3 level = glm::cross(up, axes.right);  // a unit vector, as right is perpendicular to up
  camera.direction = std::cos(glm::radians(degrees)) * level - std::sin(glm::radians(degrees)) * up;
  return camera;
}

}  // namespace volumen
