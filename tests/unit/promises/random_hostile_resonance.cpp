// Kinds of the family "hostile": values that repeat along rays with the period of a plain step, or a whole
// part of it. All samples then meet the same phase, and so do every second ones.
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

/// Returns a step in voxels that a pilot may try.
double anyStep(Chance& chance) {
  constexpr double likely[] = {0.125, 0.13, 0.15, 0.2, 0.25,    0.3,  1 / 3.0, 0.35,
                               0.4,   0.5,  0.6,  0.7, 2 / 3.0, 0.75, 0.8,     0.85};
  return chance.oneIn(2) ? likely[chance.below(16)] : chance.between(0.13, 0.85);
}

/// Returns a number of cycles a voxel that a plain step takes for none: one or two cycles a step, mostly with
/// a small difference.
double anyResonance(Chance& chance) {
  const double cycles = (1 + chance.below(2)) / anyStep(chance);
  return chance.oneIn(3) ? cycles : cycles * (1 + chance.power(-4, -1.7));
}

/// Returns x folded into 0 .. 1, up and down in turn.
double folded(double x) { return std::abs(std::remainder(x, 2)); }

/// Cycles of a comb of `points` points, of which the whole range 0 .. 1 has this many.
double cyclesOf(int points) { return (points - 1) / 2.0; }

/// Draws a comb over 0 .. 1000 for a volume of `share` times 1000, as seen along `direction`.
void combOver(Chance& chance, RandomCase& c, ivec3 size, int points, dvec3 direction, const ValueAt& share) {
  around(chance, c, volumeOf(size, dmat3(1), [&](dvec3 x) { return 1000 * share(x); }));
  const double opacity = chance.power(-2, -0.1);
  c.scene.transferFunction.points = anyComb(chance, {0, 1000}, points, opacity);
  setDepth(c, opacity, chance.power(-0.5, 0.7));
  c.scene.shading.lit = chance.oneIn(4);
  const double part = chance.between(0.3, 0.9);
  lookAlong(chance, c, direction, part);
}

/// All rays rise by whole cycles a step.
void evenRamp(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 24, 96);
  const int points = 20 + 2 * chance.below(100);
  const dvec3 direction = anyDirection(chance), across = chance.power(-4, -1) * chance.vector();
  const dvec3 slope = (direction + across) * (anyResonance(chance) / cyclesOf(points));
  combOver(chance, c, size, points, direction, [=](dvec3 x) { return folded(glm::dot(x, slope)); });
}

/// The slope varies across the picture, so that a narrow strip of it resonates.
void fannedRamp(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 32, 96);
  const int points = 20 + 2 * chance.below(100);
  const dvec3 direction = anyDirection(chance);
  const dvec3 across = glm::normalize(glm::cross(direction, chance.vector()));
  const double slope = anyResonance(chance) / cyclesOf(points), fan = chance.between(0.05, 0.5);
  const double centre = chance.between(-0.4, 0.4);
  combOver(chance, c, size, points, direction, [=](dvec3 x) {
    const dvec3 from = x - dvec3(size - 1) / 2.0;
    const double place = glm::dot(from, across) / size.x - centre;
    return folded(slope * (1 + fan * place) * glm::dot(from, direction));
  });
}

/// The slope varies along the ray, so that each ray resonates in a part of its length.
void bowedRamp(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 32, 96);
  const int points = 20 + 2 * chance.below(100);
  const dvec3 direction = anyDirection(chance);
  const double slope = anyResonance(chance) / cyclesOf(points), bow = chance.power(-2.5, 0);
  const double end = chance.between(-0.5, 0.5);
  combOver(chance, c, size, points, direction, [=](dvec3 x) {
    const double along = glm::dot(x - dvec3(size - 1) / 2.0, direction);
    return folded(slope * along * (1 + bow * (along / size.x - end)));
  });
}

/// Spheres of equal values about a point near the eye: rays in perspective resonate all over, others in
/// rings.
void spheres(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 32, 96);
  const int points = 20 + 2 * chance.below(100);
  const dvec3 direction = anyDirection(chance);
  const double slope = anyResonance(chance) / cyclesOf(points), away = size.x * chance.between(0.6, 3);
  const dvec3 middle = dvec3(size - 1) / 2.0;
  combOver(chance, c, size, points, direction,
           [=](dvec3 x) { return folded(slope * glm::distance(x, middle - away * direction)); });
  if (chance.oneIn(2)) return;
  c.scene.camera->projection = Projection::perspective;
  c.scene.camera->target = dvec3(0);
  c.scene.camera->distance = away;
  c.scene.camera->fov = chance.between(5, 40);
}

void rampInPerspective(Chance& chance, RandomCase& c) {
  evenRamp(chance, c);
  c.scene.camera->projection = Projection::perspective;
  c.scene.camera->fov = chance.power(-0.4, 1.8);
  c.scene.camera = fitCamera(*c.scene.camera, c.volume->geometry(), 1);
  c.scene.camera->fov *= chance.between(0.3, 0.9);
}

/// The values alternate from voxel to voxel. A narrow band shows where rays are midway between voxels.
void bandBetweenVoxels(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 16, 96);
  const ivec3 along = chance.oneIn(2) ? ivec3(1) : ivec3(chance.below(2), chance.below(2), 1);
  around(chance, c, volumeOf<std::int16_t>(size, dmat3(1), [&](dvec3 x) {
           const int sum = along.x * int(x.x) + along.y * int(x.y) + along.z * int(x.z);
           return 1000 * (sum % 2);
         }));
  const double at = chance.oneIn(2) ? 0.5 : chance.between(0.1, 0.9), wide = chance.power(-2, -0.7);
  const double opacity = chance.between(0.02, 0.9);
  c.scene.transferFunction.points = band(chance, {0, 1000}, at, wide, opacity);
  setDepth(c, opacity, chance.power(-0.3, 1.5));
  c.scene.shading.lit = chance.oneIn(3);
  const dvec3 direction = nearly(chance, directionOfSmallNumbers(chance));
  const double part = chance.power(-1.5, 0);
  lookAlong(chance, c, direction, part);
}

/// Layers whose distance along rays is a whole number of steps, or nearly.
void layersAtWholeSteps(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 24, 96);
  const dvec3 normal = anyDirection(chance), tilt = chance.power(-3, -0.3) * chance.vector();
  const dvec3 direction = glm::normalize(normal + tilt);
  const double step = anyStep(chance);
  const double distance = step * 2 * std::ceil(chance.between(1, 5) / step);
  const ValueAt layers = plates(normal, distance * glm::dot(normal, direction), chance.between(0.5, 2));
  around(chance, c, volumeOf(size, dmat3(1), [&](dvec3 x) { return 1000 * layers(x); }));
  const double start = chance.between(0, 0.9), opacity = chance.between(0.05, 0.95);
  c.scene.transferFunction.points = ramp(chance, {0, 1000}, start, chance.power(-2, 0), opacity);
  setDepth(c, opacity, chance.power(0, 1.7));
  const double part = chance.between(0.2, 0.9);
  lookAlong(chance, c, direction, part);
}

/// Long voxels: a step that is short along one axis is long in mm along another.
void rampInThickSlices(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 24, 64);
  const dmat3 grid = spacing({0.5, 0.5, chance.between(1, 3)});
  const int points = 20 + 2 * chance.below(100), axis = chance.below(3);
  const double slope = anyResonance(chance) / cyclesOf(points), bend = chance.power(-3, -1);
  around(chance, c, volumeOf(size, grid, [&](dvec3 x) {
           return 1000 * folded(slope * x[axis] + bend * std::sin(x[(axis + 1) % 3] / 9));
         }));
  const double opacity = chance.power(-2, -0.1);
  c.scene.transferFunction.points = anyComb(chance, {0, 1000}, points, opacity);
  setDepth(c, opacity, chance.power(-0.5, 0.7));
  dvec3 direction = chance.power(-4, -0.5) * chance.vector();
  direction[axis] = 1;
  lookAlong(chance, c, direction);
}

/// Waves near the highest frequency of the grid, whose beats are as wide as the picture or its parts.
void beats(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 32, 96);
  const dvec3 normal = directionOfSmallNumbers(chance);
  const double turns = M_PI * (1 - chance.power(-2.5, -0.3)), phase = chance.between(0, 6);
  around(chance, c, volumeOf(size, dmat3(1), [&](dvec3 x) {
           return 500 + 500 * std::cos(turns * glm::dot(x, normal) + phase);
         }));
  const double opacity = chance.between(0.02, 0.9);
  c.scene.transferFunction.points =
      band(chance, {0, 1000}, chance.between(0.1, 0.9), chance.power(-1.7, -0.5), opacity);
  if (chance.oneIn(2))
    c.scene.transferFunction.points = anyComb(chance, {0, 1000}, 4 + chance.below(20), opacity);
  setDepth(c, opacity, chance.power(-0.3, 1));
  c.scene.shading.lit = chance.oneIn(3);
  lookAlong(chance, c, nearly(chance, normal));
}

constexpr Kind kindsOfResonance[] = {{"ramp of whole cycles a step", evenRamp},
                                     {"fanned ramp", fannedRamp},
                                     {"bowed ramp", bowedRamp},
                                     {"spheres", spheres},
                                     {"ramp in perspective", rampInPerspective},
                                     {"band between voxels", bandBetweenVoxels},
                                     {"layers at whole steps", layersAtWholeSteps},
                                     {"ramp in thick slices", rampInThickSlices},
                                     {"beats", beats}};

}  // namespace

std::span<const Kind> resonantKinds() { return kindsOfResonance; }

}  // namespace volumen::tests::hostile
