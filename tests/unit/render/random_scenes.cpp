#include "tests/unit/render/random_scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/small_volumes.h"

namespace volumen::tests {
namespace {

using glm::dmat3;
using glm::dvec3;

dmat3 randomGrid(Chance& chance) {
  const int kind = chance.below(5);
  dmat3 steps(1);
  if (kind == 1)
    for (int a = 0; a < 3; ++a) steps[a][a] = chance.between(0.3, 3);
  if (kind > 1) {
    do
      for (int a = 0; a < 3; ++a) steps[a] = chance.vector() * 1.5;
    while (std::abs(glm::determinant(steps)) < 0.1);
  }
  return steps;
}

VolumePtr randomVolume(Chance& chance) {
  glm::ivec3 size(0);
  for (int a = 0; a < 3; ++a) size[a] = chance.oneIn(8) ? 1 : 1 + chance.below(9);
  const dmat3 steps = randomGrid(chance);
  const double plateau = chance.oneIn(3) ? 10 * (1 + chance.below(4)) : 0;
  const int kind = chance.below(4);
  return volumeOf(size, steps, [&](dvec3 x) {
    double v = chance.between(0, 100);
    if (kind == 0) v = 10 * x.x + 5 * x.y + 3 * x.z;
    if (kind == 1) v = 50 + 40 * std::sin(0.7 * x.x) * std::cos(0.6 * x.y + 0.5 * x.z);
    return plateau > 0 ? std::floor(v / plateau) * plateau : v;
  });
}

TransferFunction randomCurve(Chance& chance) {
  TransferFunction curve;
  curve.unitDistance = chance.power(-1, 0.7);
  curve.points.resize(1 + chance.below(7));
  double value = chance.between(-20, 60);
  for (CurvePoint& point : curve.points) {
    const double opacity = chance.oneIn(12) ? 1 : std::pow(chance.share(), 2);
    point = {float(value), chance.colour(), chance.oneIn(3) ? 0 : opacity};
    if (!chance.oneIn(3)) value += chance.oneIn(2) ? chance.between(0, 40) : 10 * chance.below(4);
  }
  if (!chance.oneIn(4)) return curve;
  curve.gradientOpacity.resize(1 + chance.below(4));
  double gradient = 0;
  for (GradientOpacityPoint& point : curve.gradientOpacity) {
    point = {gradient, chance.share()};
    gradient += chance.between(1, 30);
  }
  return curve;
}

Camera randomCamera(Chance& chance, double radiusMm) {
  Camera camera;
  camera.direction = chance.oneIn(3) ? dvec3(0, 1, 0) : chance.vector();
  camera.up = chance.oneIn(3) ? dvec3(0, 0, 1) : chance.vector();
  camera.height = radiusMm * chance.between(0.3, 2.5);
  if (chance.oneIn(2)) camera.projection = Projection::perspective;
  camera.distance = radiusMm * chance.power(-1, 1);
  camera.fov = chance.between(5, 120);
  if (chance.oneIn(2)) camera.target = chance.vector() * (radiusMm / 2);
  return camera;
}

Clip randomClip(Chance& chance, double radiusMm) {
  Clip clip;
  for (int a = 0; a < 3; ++a) {
    if (!chance.oneIn(3)) continue;
    const auto [low, high] = std::minmax({chance.share(), chance.share()});
    clip.boxLow[a] = low;
    clip.boxHigh[a] = high;
  }
  for (int i = chance.oneIn(4) ? 1 + chance.below(4) : 0; i > 0; --i)
    clip.planes.push_back({chance.vector(), chance.between(-0.2, 0.8) * radiusMm});
  return clip;
}

void randomLight(Chance& chance, Scene& scene) {
  scene.shading.lit = !chance.oneIn(4);
  scene.shading.sides = 1 + chance.below(2);
  scene.shading.localViewer = chance.oneIn(3);
  if (chance.oneIn(3)) scene.shading.gradientFloor = chance.power(-2, 2.5);
  scene.shading.ambient = chance.between(0, 0.5);
  scene.shading.specular = chance.share();
  scene.shading.shininess = chance.power(0, 2.5);
  scene.lights.resize(chance.below(4));
  for (Light& light : scene.lights) {
    light.direction = chance.vector();
    light.space = chance.oneIn(2) ? Space::camera : Space::patient;
    light.colour = chance.colour();
    light.intensity = chance.between(0, 1.5);
    light.on = !chance.oneIn(5);
  }
}

}  // namespace

RandomScene randomScene(std::uint64_t seed) {
  Chance chance(seed);
  RandomScene result;
  result.volume = randomVolume(chance);
  const VoxelGeometry& g = result.volume->geometry();
  const double radiusMm = glm::length(g.patientFromVoxelStep * dvec3(g.size)) / 2;
  Scene& scene = result.scene;
  scene.transferFunction = randomCurve(chance);
  randomLight(chance, scene);
  if (!chance.oneIn(6)) scene.camera = randomCamera(chance, radiusMm);
  scene.clip = randomClip(chance, radiusMm);
  scene.background = {chance.oneIn(3), chance.colour()};
  const Mode modes[] = {Mode::mip, Mode::minip, Mode::average};
  if (const int mode = chance.below(8); mode < 3) scene.mode = modes[mode];
  const double centre = chance.between(0, 100);
  scene.window = Window{centre, chance.between(10, 100)};
  result.size.x = 1 + chance.below(12);
  result.size.y = 1 + chance.below(12);
  return result;
}

}  // namespace volumen::tests
