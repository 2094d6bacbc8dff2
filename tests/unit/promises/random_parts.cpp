#include "tests/unit/promises/random_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>

#include "viewer/volume/histogram.h"

namespace volumen::tests {

using glm::dmat3;
using glm::dvec3;
using glm::ivec3;

const char* nameOf(Family family) {
  constexpr const char* names[] = {"pieces", "hard", "attack", "hostile"};
  return names[int(family)];
}

RandomCase randomCase(Family family, std::uint64_t seed) {
  const Chance chance(seed);
  switch (family) {
    case Family::pieces:
      return randomPiece(chance);
    case Family::hard:
      return randomHard(chance);
    case Family::attack:
      return randomAttack(chance);
    default:
      return randomHostile(chance);
  }
}

double radiusOf(const VoxelGeometry& geometry) {
  double most = 0;
  for (const dvec3& corner : geometry.boxCorners())
    most = std::max(most, glm::distance(corner, geometry.centre()));
  return most;
}

double voxelEdgeOf(const VoxelGeometry& geometry) { return std::cbrt(geometry.voxelVolume()); }

float valueIn(ValueRange range, double share) { return float(range.low + share * (range.high - range.low)); }

std::vector<double> randomShares(Chance& chance, int count) {
  std::vector<double> shares;
  for (int n = 0; n < count; ++n) shares.push_back(chance.share());
  std::sort(shares.begin(), shares.end());
  return shares;
}

float valueOfAnyVoxel(Chance& chance, const Volume& volume) {
  return volume.valueAt(std::size_t(chance.below(int(volume.geometry().voxelCount()))));
}

namespace {

dvec3 randomDirection(Chance& chance, const VoxelGeometry& geometry) {
  const int axis = chance.below(3);
  const double sign = chance.oneIn(2) ? 1 : -1;
  switch (chance.below(6)) {
    case 0: {
      dvec3 along(0);
      along[axis] = sign;
      return along;
    }
    case 1:
      return sign * glm::normalize(geometry.patientFromVoxelStep[axis]);
    default:
      return chance.vector();
  }
}

}  // namespace

Camera randomCamera(Chance& chance, const VoxelGeometry& geometry) {
  Camera camera;
  camera.direction = randomDirection(chance, geometry);
  camera.up = chance.vector();
  const bool perspective = chance.oneIn(2);
  if (perspective) camera.projection = Projection::perspective;
  camera.fov = chance.between(10, 60);
  camera = fitCamera(camera, geometry, 1);
  const double share = chance.between(0.25, 1.1);
  camera.height *= share;
  camera.fov *= share;
  if (perspective && chance.oneIn(4)) {  // places the eye inside or close by
    camera.distance = radiusOf(geometry) * chance.power(-1, 0);
    camera.fov = chance.between(30, 100);
  }
  *camera.target += chance.vector() * (0.3 * radiusOf(geometry));
  return camera;
}

Clip randomClip(Chance& chance, const VoxelGeometry& geometry) {
  Clip clip;
  if (chance.oneIn(4))
    for (int a = 0; a < 3; ++a) {
      if (chance.oneIn(3)) continue;
      const std::vector<double> ends = randomShares(chance, 2);
      clip.boxLow[a] = ends[0];
      clip.boxHigh[a] = ends[1];
    }
  if (chance.oneIn(4))
    for (int count = 1 + chance.below(3); count > 0; --count) {
      const dvec3 normal = glm::normalize(chance.vector());
      const double beyond = chance.between(-0.1, 0.6) * radiusOf(geometry);
      clip.planes.push_back({normal, glm::dot(normal, geometry.centre()) + beyond});
    }
  return clip;
}

void addRandomLight(Chance& chance, Scene& scene, int mostLights, double mostIntensity) {
  scene.shading.lit = !chance.oneIn(4);
  scene.shading.sides = chance.oneIn(4) ? 1 : 2;
  scene.shading.localViewer = chance.oneIn(4);
  scene.shading.ambient = chance.between(0, 0.5);
  scene.shading.diffuse = chance.between(0.2, 1);
  scene.shading.specular = chance.oneIn(4) ? 0 : chance.share();
  scene.lights.resize(chance.below(mostLights + 1));
  for (Light& light : scene.lights) {
    light.direction = chance.vector();
    light.space = chance.oneIn(2) ? Space::camera : Space::patient;
    if (chance.oneIn(2)) light.colour = chance.colour();
    light.intensity = chance.between(0.2, mostIntensity);
    light.on = !chance.oneIn(8);
  }
}

std::vector<GradientOpacityPoint> randomGradientOpacity(Chance& chance, double perMm) {
  const double start = perMm * chance.power(-1.5, 0), wide = perMm * chance.power(-1.5, 0);
  switch (chance.below(4)) {
    case 0:
      return {{0, 0}, {start, 0}, {start + wide, 1}};
    case 1:
      return {{start, 0}, {start + wide, 1}, {start + 2 * wide, 0}};
    case 2:
      return {{start, chance.share()}, {start, chance.share()}};
    default: {
      std::vector<GradientOpacityPoint> points;
      for (double share : randomShares(chance, 1 + chance.below(4)))
        points.push_back({perMm * share, chance.share()});
      return points;
    }
  }
}

Mode randomMode(Chance& chance) {
  constexpr Mode projections[] = {Mode::mip, Mode::minip, Mode::average};
  const int mode = chance.below(8);
  return mode < 3 ? projections[mode] : Mode::composite;
}

Window windowAbout(Chance& chance, Mode mode, ValueRange range, double width) {
  double low = 0.2, high = 0.7;
  if (mode == Mode::mip) low = 0.4, high = 1;
  if (mode == Mode::minip) low = 0, high = 0.5;
  return {double(valueIn(range, chance.between(low, high))), width};
}

Background randomBackground(Chance& chance) {
  return {chance.oneIn(4), chance.oneIn(2) ? dvec3(0) : chance.colour()};
}

glm::ivec2 randomPictureSize(Chance& chance) {
  const int width = 24 + chance.below(9);
  return {width, 24 + chance.below(9)};
}

ivec3 anySize(Chance& chance, int least, int most) {
  ivec3 size;
  for (int a = 0; a < 3; ++a) size[a] = least + chance.below(most - least + 1);
  return size;
}

dmat3 spacing(dvec3 mm) {
  dmat3 steps(1);
  for (int a = 0; a < 3; ++a) steps[a][a] = mm[a];
  return steps;
}

ValueAt ball(ivec3 size, double share) {
  return [=](dvec3 x) {
    const dvec3 from = (x - dvec3(size - 1) * 0.48) / dvec3(size);
    return std::erfc((glm::length(from) - share) * 12) / 2;
  };
}

ValueAt noise(Chance& chance) {
  const auto random = std::make_shared<Chance>(std::uint64_t(chance.below(1 << 30)));
  return [random](dvec3) { return random->share(); };
}

std::vector<CurvePoint> anyCurve(Chance& chance, ValueRange range) {
  std::vector<CurvePoint> points;
  for (double share : randomShares(chance, 2 + chance.below(5)))
    points.push_back({valueIn(range, share), chance.colour(), chance.oneIn(3) ? 0 : chance.share()});
  points.back().opacity = chance.between(0.1, 1);
  return points;
}

std::vector<CurvePoint> ramp(Chance& chance, ValueRange range, double start, double wide, double opacity) {
  return {{valueIn(range, start), chance.colour(), 0},
          {valueIn(range, start + wide), chance.colour(), opacity}};
}

std::vector<CurvePoint> band(Chance& chance, ValueRange range, double middle, double wide, double opacity) {
  const dvec3 colour = chance.colour();
  return {{valueIn(range, middle - wide), colour, 0},
          {valueIn(range, middle), colour, opacity},
          {valueIn(range, middle + wide), colour, 0}};
}

void around(Chance& chance, RandomCase& c, VolumePtr volume) {
  c.volume = std::move(volume);
  const ValueRange range = valueRange(*c.volume);
  c.scene.transferFunction.points = anyCurve(chance, range);
  c.scene.transferFunction.unitDistance = voxelEdgeOf(c.volume->geometry()) * chance.power(-0.5, 1);
  c.scene.window = windowAbout(chance, c.scene.mode, range, std::max(1e-6, range.high - range.low));
  addRandomLight(chance, c.scene, 4, chance.oneIn(5) ? 3 : 1);
  c.scene.shading.shininess = chance.power(0, 3);
  c.scene.camera = randomCamera(chance, c.volume->geometry());
  c.scene.background = randomBackground(chance);
}

ValueRange rangeOf(const RandomCase& c) { return valueRange(*c.volume); }

}  // namespace volumen::tests
