#include "ui/workspace/camera_moves.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "viewer/scene/first_camera.h"

namespace volumen {

namespace {

constexpr double smallestHeight = 0.1, largestHeight = 1e5;  // mm

glm::dvec3 turned(glm::dvec3 v, glm::dvec3 axis, double angle) {
  return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
         axis * glm::dot(axis, v) * (1 - std::cos(angle));
}

glm::dvec3 eyeOf(const Camera& camera) {
  return *camera.target - camera.distance * glm::normalize(camera.direction);
}

}  // namespace

double heightAtTarget(const Camera& camera) {
  return camera.projection == Projection::parallel
             ? camera.height
             : 2 * camera.distance * std::tan(glm::radians(camera.fov) / 2);
}

Camera cameraInUse(const Scene& scene, const VoxelGeometry& geometry, glm::dvec2 size) {
  if (!scene.camera) return fitCamera(firstCamera(geometry), geometry, size.x / size.y);
  Camera camera = *scene.camera;
  if (!camera.target) camera.target = geometry.centre();
  return camera;
}

SightLine sightLine(const Camera& camera, glm::dvec2 size, glm::dvec2 position) {
  const CameraAxes axes = cameraAxes(camera);
  const double mm = heightAtTarget(camera) / size.y;
  const glm::dvec3 q =
      *camera.target + (position.x - size.x / 2) * mm * axes.right + (size.y / 2 - position.y) * mm * axes.up;
  if (camera.projection == Projection::parallel) return {q, axes.direction};
  const glm::dvec3 eye = eyeOf(camera);
  return {eye, glm::normalize(q - eye)};
}

Lasso lassoOf(const Camera& camera, glm::dvec2 size, const std::vector<glm::dvec2>& outline) {
  const CameraAxes axes = cameraAxes(camera);
  Lasso lasso;
  lasso.perspective = camera.projection == Projection::perspective;
  lasso.origin = lasso.perspective ? eyeOf(camera) : *camera.target;
  lasso.right = axes.right;
  lasso.down = -axes.up;
  const double mm = heightAtTarget(camera) / size.y / (lasso.perspective ? camera.distance : 1);
  for (const glm::dvec2 p : outline) lasso.points.push_back((p - size / 2.0) * mm);
  return lasso;
}

double mmPerPixel(const Camera& camera, glm::dvec2 size, glm::dvec3 pPatient) {
  if (camera.projection == Projection::parallel) return camera.height / size.y;
  const double depth = glm::dot(pPatient - eyeOf(camera), glm::normalize(camera.direction));
  return 2 * std::max(depth, 1e-3) * std::tan(glm::radians(camera.fov) / 2) / size.y;
}

glm::dvec2 seenAt(const Camera& camera, glm::dvec2 size, glm::dvec3 pPatient) {
  const CameraAxes axes = cameraAxes(camera);
  const glm::dvec3 from = camera.projection == Projection::parallel ? *camera.target : eyeOf(camera);
  const double mm = mmPerPixel(camera, size, pPatient);
  const glm::dvec3 v = pPatient - from;
  return {size.x / 2 + glm::dot(v, axes.right) / mm, size.y / 2 - glm::dot(v, axes.up) / mm};
}

Camera orbited(Camera camera, glm::dvec3 pivot, double turn, double tilt) {
  const CameraAxes axes = cameraAxes(camera);
  // When the camera is upside down, the picture still follows the hand.
  const double side = axes.up.z < 0 ? -1 : 1;
  const auto moved = [&](glm::dvec3 v) {
    return turned(turned(v, axes.right, -tilt), {0, 0, 1}, -turn * side);
  };
  camera.direction = moved(axes.direction);
  camera.up = moved(axes.up);
  camera.target = pivot + moved(*camera.target - pivot);
  return camera;
}

Camera rolled(Camera camera, double angle) {
  const CameraAxes axes = cameraAxes(camera);
  camera.up = turned(axes.up, axes.direction, -angle);
  return camera;
}

Camera panned(Camera camera, glm::dvec2 size, glm::dvec2 moved, glm::dvec3 at) {
  const CameraAxes axes = cameraAxes(camera);
  const double mm = mmPerPixel(camera, size, at);
  camera.target = *camera.target - moved.x * mm * axes.right + moved.y * mm * axes.up;
  return camera;
}

Camera zoomedAt(Camera camera, glm::dvec3 fixed, double factor) {
  const double height = heightAtTarget(camera);
  factor = std::clamp(height * factor, smallestHeight, largestHeight) / height;
  camera.height *= factor;
  camera.distance *= factor;
  camera.target = fixed + (*camera.target - fixed) * factor;
  return camera;
}

Camera withProjection(Camera camera, Projection projection) {
  if (camera.projection == projection) return camera;
  const double height = heightAtTarget(camera);
  camera.projection = projection;
  camera.height = height;
  camera.distance = height / (2 * std::tan(glm::radians(camera.fov) / 2));
  return camera;
}

std::string sideLetters(glm::dvec3 direction) {
  const glm::dvec3 d = glm::normalize(direction);
  std::array<std::pair<double, char>, 3> sides{
      {{d.x, d.x > 0 ? 'L' : 'R'}, {d.y, d.y > 0 ? 'P' : 'A'}, {d.z, d.z > 0 ? 'S' : 'I'}}};
  std::stable_sort(sides.begin(), sides.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.first) > std::abs(b.first); });
  std::string letters;
  for (const auto& [part, letter] : sides)
    if (std::abs(part) > 0.3) letters += letter;
  return letters;
}

std::string sideWords(glm::dvec3 direction) {
  std::string words;
  for (const char letter : sideLetters(direction))
    for (const std::string& name : standardViewNames())
      if (std::toupper(name[0]) == letter) words += (words.empty() ? "" : "-") + name;
  return words;
}

std::string viewName(const Camera& camera) {
  const CameraAxes axes = cameraAxes(camera);
  for (const std::string& name : standardViewNames())
    if (glm::dot(cameraAxes(*standardView(name)).direction, axes.direction) > std::cos(glm::radians(1.0)))
      return name;
  return {};
}

}  // namespace volumen
