#include "tests/unit/hard/hard_cases.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "tests/fixtures/brute_matter.h"
#include "tests/fixtures/small_volumes.h"

namespace volumen::tests {

using glm::dvec3;

void HardCases::addBoth(const HardCase& hardCase) {
  add(hardCase);
  HardCase& twin = add(hardCase);
  twin.name += ", perspective";
  Camera& camera = *twin.scene.camera;
  camera.projection = Projection::perspective;
  camera.distance = camera.height / 2 / std::tan(glm::radians(camera.fov) / 2);
}

const std::vector<HardCase>& hardCases() {
  static const HardCases cases = [] {
    HardCases all;
    addVolumeCases(all);
    addMatterCases(all);
    addCurveCases(all);
    addLightCases(all);
    addViewCases(all);
    return all;
  }();
  return cases.all();
}

double lengthOfRay(const Scene& scene, const VoxelGeometry& geometry, glm::ivec2 size, int px, int py) {
  const Camera& camera = *scene.camera;
  const glm::dmat3 axes = axesOf(camera);
  const bool perspective = camera.projection == Projection::perspective;
  const double height =
      perspective ? 2 * camera.distance * std::tan(glm::radians(camera.fov) / 2) : camera.height;
  const double a = ((px + 0.5) / size.x - 0.5) * height * size.x / size.y;
  const double b = (0.5 - (py + 0.5) / size.y) * height;
  const dvec3 q = *camera.target + a * axes[0] + b * axes[1];
  const dvec3 toQ = camera.distance * axes[2] + a * axes[0] + b * axes[1];
  const dvec3 direction = perspective ? glm::normalize(toQ) : axes[2];
  // t is measured from q. The eye lies at negative t.
  double t0 = perspective ? -glm::length(toQ) : -std::numeric_limits<double>::infinity();
  double t1 = std::numeric_limits<double>::infinity();
  const auto keepBelow = [&](double at, double slope, double bound) {  // at + slope t <= bound
    if (slope > 0) t1 = std::min(t1, (bound - at) / slope);
    if (slope < 0) t0 = std::max(t0, (bound - at) / slope);
    if (slope == 0 && at > bound) t1 = -std::numeric_limits<double>::infinity();
  };
  const glm::dmat3 voxelFromMm = glm::inverse(geometry.patientFromVoxelStep);
  const dvec3 x = voxelFromMm * (q - geometry.origin) + 0.5, move = voxelFromMm * direction;
  for (int axis = 0; axis < 3; ++axis) {
    keepBelow(x[axis], move[axis], scene.clip.boxHigh[axis] * geometry.size[axis]);
    keepBelow(-x[axis], -move[axis], -scene.clip.boxLow[axis] * geometry.size[axis]);
  }
  for (const ClipPlane& plane : scene.clip.planes) {
    const dvec3 normal = plane.normal / glm::length(plane.normal);
    keepBelow(glm::dot(normal, q), glm::dot(normal, direction), plane.offset);
  }
  return std::max(0.0, t1 - t0);
}

Scene sceneOf(const Volume& volume, std::vector<CurvePoint> points, dvec3 direction) {
  Scene scene;
  scene.transferFunction.points = std::move(points);
  scene.transferFunction.unitDistance = std::cbrt(volume.geometry().voxelVolume());
  Camera camera;
  camera.direction = direction;
  if (std::abs(direction.z) > 0.9 * glm::length(direction)) camera.up = {0, 1, 0};
  scene.camera = fitCamera(camera, volume.geometry(), 1);
  return scene;
}

std::vector<CurvePoint> softCurve(double low, double high) {
  const auto at = [=](double share) { return float(low + share * (high - low)); };
  return {{at(0.2), {0.3, 0.4, 0.9}, 0},
          {at(0.45), {0.9, 0.5, 0.3}, 0.03},
          {at(0.6), {0.9, 0.7, 0.4}, 0.2},
          {at(1), {1, 1, 0.9}, 0.9}};
}

std::vector<CurvePoint> steppedCurve(double low, double high) {
  const auto at = [=](double share) { return float(low + share * (high - low)); };
  return {{at(0.4), {0.8, 0.3, 0.2}, 0},
          {at(0.4), {0.8, 0.3, 0.2}, 0.15},
          {at(0.65), {0.9, 0.5, 0.2}, 0.05},
          {at(0.65), {0.4, 0.9, 1}, 0.8}};
}

double waves(dvec3 x) {
  const double blobs = std::sin(0.61 * x.x + 0.3) + std::sin(0.53 * x.y + 1.1) * std::sin(0.47 * x.z + 0.4) +
                       std::cos(0.4 * (x.x - x.z));
  const double grain = std::sin(12.9898 * x.x + 78.233 * x.y + 37.719 * x.z) * 43758.5453;
  return 0.5 + 0.155 * blobs + 0.03 * (grain - std::floor(grain));
}

VolumePtr wavesVolume() {
  static const VolumePtr volume = volumeOf({20, 18, 16}, glm::dmat3({0.8, 0, 0}, {0, 1, 0}, {0, 0, 1.25}),
                                           [](dvec3 x) { return 1000 * waves(x); });
  return volume;
}

VolumePtr rampVolume() {
  static const VolumePtr volume = volumeOf(glm::ivec3(20), glm::dmat3(1), [](dvec3 x) { return 100 * x.y; });
  return volume;
}

}  // namespace volumen::tests
