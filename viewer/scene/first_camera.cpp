#include "viewer/scene/first_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>

namespace volumen {

namespace {

// Views in which flat images are read: axial ones from below, with the front on top.
constexpr const char* readingViews[] = {"inferior", "anterior", "left"};

// Seen edge-on, such a volume would be a strip.
bool isFlat(const VoxelGeometry& g) {
  const glm::dvec3 mm = g.spacing() * glm::dvec3(g.size);
  const int across = std::min(g.size.x, g.size.y);
  const bool few = g.size.z <= 10 && 4 * g.size.z <= across;
  return across > 1 && (few || mm.z < 0.5 * std::min(mm.x, mm.y));
}

// Returns `direction` or its opposite, whichever is nearer to `to`.
glm::dvec3 towards(glm::dvec3 direction, glm::dvec3 to) {
  return glm::dot(direction, to) < 0 ? -direction : direction;
}

}  // namespace

Camera firstCamera(const VoxelGeometry& geometry) {
  if (!isFlat(geometry)) return {};
  const glm::dmat3& step = geometry.patientFromVoxelStep;
  const glm::dvec3 normal = glm::normalize(glm::cross(step[0], step[1]));
  const auto along = [&](const Camera& view) { return std::abs(glm::dot(view.direction, normal)); };
  std::array<Camera, std::size(readingViews)> views;
  std::transform(std::begin(readingViews), std::end(readingViews), views.begin(),
                 [](const char* name) { return *standardView(name); });
  Camera camera = *std::max_element(views.begin(), views.end(),
                                    [&](const Camera& a, const Camera& b) { return along(a) < along(b); });
  camera.direction = towards(normal, camera.direction);
  // Chooses the image edge closest to upright as `up`.
  const glm::dvec3 row = towards(glm::normalize(step[0]), camera.up);
  const glm::dvec3 column = towards(glm::normalize(step[1]), camera.up);
  camera.up = glm::dot(row, camera.up) > glm::dot(column, camera.up) ? row : column;
  return camera;
}

}  // namespace volumen
