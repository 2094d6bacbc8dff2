// Kinds of the family "hostile": extreme light, cameras and unit distances.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/promises/random_hostile.h"

namespace volumen::tests::hostile {
namespace {

using glm::dmat3;
using glm::dvec3;
using glm::ivec3;

/// Sets one to three lights with sharp highlights.
void addHighlights(Chance& chance, Scene& scene) {
  scene.shading.lit = true;
  scene.shading.specular = chance.between(0.5, 1);
  scene.shading.shininess = chance.power(2, 3);
  scene.shading.localViewer = chance.oneIn(2);
  scene.lights.resize(std::size_t(1 + chance.below(3)));
  for (Light& light : scene.lights) {
    light.direction = chance.vector() + dvec3(0, 0, chance.between(0, 1.5));
    light.space = chance.oneIn(3) ? Space::patient : Space::camera;
    light.intensity = chance.power(-0.3, 1);
    light.on = true;
  }
}

/// Sets an opaque or nearly opaque surface at half of 1000.
void addSurface(Chance& chance, RandomCase& c) {
  const double wide = chance.power(0, 2.5), opacity = chance.oneIn(2) ? 1 : chance.between(0.5, 1);
  c.scene.transferFunction.points = {{float(500 - wide / 2), chance.colour(), 0},
                                     {float(500 + wide / 2), chance.colour(), opacity}};
  c.scene.transferFunction.unitDistance = chance.power(-2, 0.5);
}

/// A surface with waves of 2 to 6 voxels, seen from a grazing direction.
void corrugatedPlane(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 24, 96);
  const double first = 2 * M_PI / chance.between(2, 6), second = 2 * M_PI / chance.between(2, 6);
  const double height = chance.power(-1.3, 0.3), edge = chance.between(1, 4);
  const bool both = chance.oneIn(2);
  around(chance, c, volumeOf(size, dmat3(1), [&](dvec3 x) {
           const double wave = std::sin(first * x.x) * (both ? std::sin(second * x.y) : 1);
           return 1000 * std::clamp(0.5 + (0.5 * size.z + height * wave - x.z) / edge, 0.0, 1.0);
         }));
  addSurface(chance, c);
  addHighlights(chance, c.scene);
  const double turn = chance.between(0, 2 * M_PI), rise = chance.between(0.03, 0.5);
  lookAlong(chance, c, dvec3(std::cos(turn), std::sin(turn), -rise));
}

void corrugatedBall(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 24, 96);
  const ValueAt waves = ripples(chance, chance.between(2.5, 6), 1 + chance.below(3));
  const double radius = chance.between(0.2, 0.45) * size.x, height = chance.power(-1, 0.5);
  const double edge = chance.between(1, 4);
  around(chance, c, volumeOf(size, dmat3(1), [&](dvec3 x) {
           const double from = glm::distance(x, dvec3(size - 1) / 2.0);
           return 1000 * std::clamp(0.5 + (radius + height * waves(x) - from) / edge, 0.0, 1.0);
         }));
  addSurface(chance, c);
  addHighlights(chance, c.scene);
}

/// A smooth translucent body whose normals are those of faint noise.
void normalsOfNoise(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 24, 80);
  const ValueAt smooth = hill(size), grain = noise(chance);
  const double amplitude = chance.power(-3, 1.5);
  around(chance, c,
         volumeOf(size, dmat3(1), [&](dvec3 x) { return 100 * smooth(x) + amplitude * grain(x); }));
  addHighlights(chance, c.scene);
  c.scene.shading.gradientFloor = amplitude * chance.power(-3, 0.3);
  const double opacity = chance.between(0.02, 0.9);
  c.scene.transferFunction.points = ramp(chance, {0, 100}, chance.between(0, 0.5), 0.3, opacity);
  setDepth(c, opacity, chance.power(-0.3, 1.5));
}

/// Plates lit from one side: the normal turns over within each.
void platesLitOnOneSide(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 20, 80);
  const ValueAt detail = anyLattice(chance);
  around(chance, c, volumeOf(size, dmat3(1), [&](dvec3 x) { return 1000 * detail(x); }));
  addHighlights(chance, c.scene);
  c.scene.shading.sides = 1;
  c.scene.shading.ambient = 0;
  c.scene.shading.gradientFloor = chance.power(-2, 3);
  const double opacity = chance.between(0.05, 0.95);
  c.scene.transferFunction.points = ramp(chance, {0, 1000}, chance.share() / 2, chance.power(-2, 0), opacity);
  setDepth(c, opacity, chance.power(-0.3, 1.7));
  lookAlong(chance, c, nearly(chance, directionOfSmallNumbers(chance)));
}

void anyUnitDistance(Chance& chance, RandomCase& c) {
  aroundCt(chance, c, chance.power(0, 2));
  const double start = chance.between(-200, 300), wide = chance.power(0, 3);
  c.scene.transferFunction.points = {
      {float(start), chance.colour(), 0},
      {float(start + wide), chance.colour(), chance.oneIn(2) ? chance.power(-6, 0) : 1}};
  c.scene.transferFunction.unitDistance = chance.power(-6, 6);
}

void insideOfBone(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 24, 96);
  const ValueAt bars = network(chance), air = ripples(chance, chance.between(3, 12), 3);
  around(chance, c, volumeOf<std::int16_t>(size, dmat3(chance.between(0.3, 1)), [&](dvec3 x) {
           return std::round(1000 * std::clamp(0.5 + 2 * bars(x), 0.0, 1.0) + 100 * air(x));
         }));
  addSurface(chance, c);
  if (chance.oneIn(2)) addHighlights(chance, c.scene);
  lookFromInside(chance, c);
}

void insideOfCt(Chance& chance, RandomCase& c) {
  aroundCt(chance, c, chance.power(0, 2));
  const double opacity = chance.between(0.05, 0.95);
  c.scene.transferFunction.points =
      ramp(chance, {-1000, 1000}, chance.between(0, 0.7), chance.power(-3, -0.5), opacity);
  setDepth(c, opacity, chance.power(0, 2));
  lookFromInside(chance, c);
}

/// Few voxels fill the picture, so that their edges and corners are wide areas of it.
void closeToVoxels(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 10, 24);
  const ValueAt detail = chance.oneIn(2) ? noise(chance) : anyLattice(chance);
  around(chance, c, volumeOf(size, dmat3(1), [&](dvec3 x) { return 1000 * detail(x); }));
  const double opacity = chance.between(0.05, 0.99);
  c.scene.transferFunction.points =
      band(chance, {0, 1000}, chance.between(0.1, 0.9), chance.power(-2.5, -0.5), opacity);
  setDepth(c, opacity, chance.power(0, 1.7));
  const dvec3 direction = nearly(chance, anyDirection(chance));
  const double part = chance.power(-2, -0.7);
  lookAlong(chance, c, direction, part);
}

constexpr Kind kindsOfLight[] = {{"corrugated plane", corrugatedPlane},
                                 {"corrugated ball", corrugatedBall},
                                 {"normals of noise", normalsOfNoise},
                                 {"plates lit on one side", platesLitOnOneSide},
                                 {"any unit distance in CT", anyUnitDistance},
                                 {"inside of bone", insideOfBone},
                                 {"inside of CT", insideOfCt},
                                 {"close to voxels", closeToVoxels}};

}  // namespace

std::span<const Kind> lightKinds() { return kindsOfLight; }

}  // namespace volumen::tests::hostile
