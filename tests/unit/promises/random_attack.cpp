// The family "attack": kinds of scenes chosen to break the levels. Each kind is one function.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/promises/random_parts.h"
#include "viewer/volume/histogram.h"

namespace volumen::tests {
namespace {

using glm::dmat3;
using glm::dvec3;
using glm::ivec3;

void aroundBall(Chance& chance, RandomCase& c, const dmat3& steps = dmat3(1), double slope = 1,
                double offset = 0) {
  const ivec3 size = anySize(chance);
  const ValueAt share = ball(size, chance.between(0.15, 0.4));
  around(chance, c, volumeOf(size, steps, [&](dvec3 x) { return offset + slope * share(x); }));
}

void aroundNoise(Chance& chance, RandomCase& c, const dmat3& steps = dmat3(1)) {
  around(chance, c, volumeOf(anySize(chance), steps, noise(chance)));
}

void checkers(Chance& chance, RandomCase& c) {
  around(chance, c, volumeOf<std::uint8_t>(anySize(chance), dmat3(1), [&](dvec3 x) {
           return 255 * ((int(x.x) + int(x.y) + int(x.z)) % 2);
         }));
  c.scene.camera->direction = directionOfSmallNumbers(chance);
}

// Thin things.

void thinShell(Chance& chance, RandomCase& c) {
  aroundBall(chance, c, dmat3(1), 1000);
  c.scene.transferFunction.points =
      band(chance, rangeOf(c), chance.between(0.1, 0.9), chance.power(-4, -1.5), chance.between(0.3, 1));
  c.scene.transferFunction.unitDistance = chance.power(-3, 0);
}

void thinPlate(Chance& chance, RandomCase& c) {
  const int axis = chance.below(3), place = 4 + chance.below(5);
  around(chance, c, volumeOf<std::int16_t>(anySize(chance), dmat3(1), [&](dvec3 x) {
           return int(x[axis]) == place ? 1000 : 0;
         }));
  c.scene.transferFunction.points = ramp(chance, rangeOf(c), chance.share(), chance.power(-3, -0.5), 1);
}

void oneBrightVoxel(Chance& chance, RandomCase& c) {
  const dvec3 place(5 + chance.below(4), 5 + chance.below(4), 5 + chance.below(4));
  around(chance, c, volumeOf(anySize(chance), dmat3(1), [&](dvec3 x) { return x == place ? 1000.0 : 0; }));
}

void oneVoxelThick(Chance& chance, RandomCase& c) {
  ivec3 size = anySize(chance);
  size[chance.below(3)] = 1;
  if (chance.oneIn(3)) size[chance.below(3)] = 1;
  around(chance, c, volumeOf(size, dmat3(1), noise(chance)));
}

void stepOnAPlateau(Chance& chance, RandomCase& c) {
  around(chance, c,
         volumeOf<std::int16_t>(anySize(chance), dmat3(1), [&](dvec3) { return 100 * chance.below(4); }));
  const float at = float(100 * chance.below(4));
  c.scene.transferFunction.points = {{at, chance.colour(), 0}, {at, chance.colour(), chance.share()}};
}

void manyPoints(Chance& chance, RandomCase& c) {
  aroundBall(chance, c, dmat3(1), 1000);
  std::vector<CurvePoint> points;
  const int count = 64 << chance.below(3);
  for (int n = 0; n < count; ++n)
    points.push_back({valueIn(rangeOf(c), n / double(count)), chance.colour(), n % 2 ? chance.share() : 0});
  c.scene.transferFunction.points = points;
  if (chance.oneIn(3)) c.scene.transferFunction.gradientOpacity = randomGradientOpacity(chance, 100);
}

void pointsAnUlpApart(Chance& chance, RandomCase& c) {
  aroundBall(chance, c, dmat3(1), 1000);
  std::vector<CurvePoint> points;
  float value = valueIn(rangeOf(c), chance.share());
  for (int n = 0; n < 6; ++n, value = std::nextafter(value, 1e9f))
    points.push_back({value, chance.colour(), n % 2 ? chance.share() : 0});
  c.scene.transferFunction.points = points;
}

// Numbers far from 1.

void longVoxels(Chance& chance, RandomCase& c) {
  dvec3 mm(0.1, 1, 10);
  std::swap(mm[chance.below(3)], mm[chance.below(3)]);
  chance.oneIn(2) ? aroundBall(chance, c, spacing(mm)) : aroundNoise(chance, c, spacing(mm));
}

void smallVoxels(Chance& chance, RandomCase& c) { aroundBall(chance, c, 1e-4 * dmat3(1)); }
void largeVoxels(Chance& chance, RandomCase& c) { aroundNoise(chance, c, 1e4 * dmat3(1)); }

void shearedVoxels(Chance& chance, RandomCase& c) {
  dmat3 steps(1);
  steps[1].x = chance.between(-2, 2);
  steps[2].y = chance.between(-2, 2);
  if (chance.oneIn(2)) steps[0].x = -1;
  aroundBall(chance, c, steps);
}

void farOrigin(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance);
  const VolumePtr near = volumeOf(size, dmat3(1), ball(size));
  VolumeParts parts;
  parts.geometry = near->geometry();
  parts.geometry.origin += 1e7 * chance.vector();
  parts.values = near->stored();
  around(chance, c, volumeFrom(std::move(parts)));
}

void valuesAnUlpApart(Chance& chance, RandomCase& c) {
  const float base = float(chance.power(-3, 6));
  const ivec3 size = anySize(chance);
  const ValueAt share = ball(size);
  const double ulp = double(std::nextafter(base, 1e30f)) - double(base);
  around(chance, c,
         volumeOf(size, dmat3(1), [&](dvec3 x) { return double(base) + std::round(share(x) * 5) * ulp; }));
}

void farValues(Chance& chance, RandomCase& c) {
  aroundBall(chance, c, dmat3(1), 1, chance.oneIn(2) ? 1e6 : -1e6);
}

void hugeValues(Chance& chance, RandomCase& c) {
  aroundBall(chance, c, dmat3(1), chance.power(25, 29), chance.oneIn(2) ? 0 : -chance.power(25, 29));
}

void tinyValues(Chance& chance, RandomCase& c) { aroundBall(chance, c, dmat3(1), chance.power(-36, -20)); }

void outlier(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance);
  const ValueAt share = ball(size);
  around(chance, c, volumeOf(size, dmat3(1), [&](dvec3 x) { return x == dvec3(7) ? 1e5 : share(x); }));
  c.scene.transferFunction.points = anyCurve(chance, {0, 1});
}

void unitDistanceOfAnyPower(Chance& chance, RandomCase& c) {
  aroundBall(chance, c, dmat3(1), 1000);
  c.scene.transferFunction.unitDistance = chance.oneIn(2) ? chance.power(-40, 38) : chance.power(25, 38);
}

// Light and opacity at their limits.

void opaque(Chance& chance, RandomCase& c) {
  chance.oneIn(2) ? aroundBall(chance, c, dmat3(1), 1000) : aroundNoise(chance, c);
  for (CurvePoint& p : c.scene.transferFunction.points) p.opacity = 1 - chance.power(-7, -2);
  c.scene.transferFunction.unitDistance = chance.power(-2, 0);
}

void almostNothing(Chance& chance, RandomCase& c) {
  aroundNoise(chance, c);
  for (CurvePoint& p : c.scene.transferFunction.points) p.opacity = chance.power(-7, -2);
}

void narrowGradientOpacity(Chance& chance, RandomCase& c) {
  aroundBall(chance, c, dmat3(1), 1000);
  const double at = chance.power(0, 2.5);
  c.scene.transferFunction.gradientOpacity = {{at, 0}, {at * 1.001, 1}, {at * 1.01, 0}};
  if (chance.oneIn(2)) c.scene.transferFunction.points = {{0, chance.colour(), chance.share()}};
}

void sharpHighlight(Chance& chance, RandomCase& c) {
  aroundBall(chance, c, dmat3(1), 1000);
  c.scene.shading.lit = true;
  c.scene.shading.specular = 1;
  c.scene.shading.shininess = chance.power(3, 4);
  for (Light& light : c.scene.lights) light.intensity = chance.between(1, 20);
}

/// Sets 8 to 32 lights, in a ring around or close together.
void manyLights(Chance& chance, RandomCase& c) {
  chance.oneIn(2) ? aroundBall(chance, c, dmat3(1), 1000) : aroundNoise(chance, c);
  c.scene.shading.lit = true;
  c.scene.shading.specular = chance.share();
  c.scene.lights.clear();
  const int count = 8 + chance.below(25);
  const double intensity = chance.between(0.2, 3) / count;
  const bool inARing = chance.oneIn(2);
  const dvec3 middle = chance.vector();
  const double apart = chance.power(-3, -1);
  for (int n = 0; n < count; ++n) {
    const double turn = 2 * M_PI * n / count;
    const dvec3 direction =
        inARing ? dvec3(std::cos(turn), std::sin(turn), chance.share()) : middle + apart * chance.vector();
    c.scene.lights.push_back(
        {direction, chance.oneIn(2) ? Space::camera : Space::patient, chance.colour(), intensity, true});
  }
}

void lowGradientFloor(Chance& chance, RandomCase& c) {
  aroundBall(chance, c, dmat3(1), 1000);
  c.scene.shading.lit = true;
  c.scene.shading.gradientFloor = chance.power(-9, 0);
  c.scene.transferFunction.points =
      ramp(chance, rangeOf(c), chance.share(), chance.power(-3, -1), chance.between(0.5, 1));
  c.scene.transferFunction.unitDistance = chance.power(-3, 0);
}

// Positions of the camera.

void eyeInside(Chance& chance, RandomCase& c) {
  chance.oneIn(2) ? aroundBall(chance, c, dmat3(1), 1000) : aroundNoise(chance, c);
  Camera& camera = *c.scene.camera;
  camera.projection = Projection::perspective;
  camera.target = c.volume->geometry().centre() + chance.vector();
  camera.distance = chance.power(-4, 0.5);
  camera.fov = chance.between(20, 170);
}

void nearlyAlongAnAxis(Chance& chance, RandomCase& c) {
  aroundNoise(chance, c);
  c.scene.camera->direction = dvec3(1, chance.power(-12, -3), chance.oneIn(2) ? 0 : chance.power(-12, -3));
}

void closeUp(Chance& chance, RandomCase& c) {
  aroundBall(chance, c, dmat3(1), 1000);
  c.scene.camera->projection = Projection::parallel;
  c.scene.camera->height = chance.power(-5, -1);
}

void thinSlab(Chance& chance, RandomCase& c) {
  aroundNoise(chance, c);
  const int axis = chance.below(3);
  c.scene.clip.boxLow[axis] = chance.share();
  c.scene.clip.boxHigh[axis] = std::min(1.0, c.scene.clip.boxLow[axis] + chance.power(-6, -1));
}

void wedge(Chance& chance, RandomCase& c) {
  aroundBall(chance, c, dmat3(1), 1000);
  const dvec3 normal = glm::normalize(chance.vector());
  const double offset = glm::dot(normal, c.volume->geometry().centre());
  c.scene.clip.planes = {{normal, offset}, {-normal + chance.power(-6, -1) * chance.vector(), -offset}};
}

struct Kind {
  const char* name;
  void (*make)(Chance&, RandomCase&);
};
constexpr Kind kinds[] = {{"checkers", checkers},
                          {"thin shell", thinShell},
                          {"thin plate", thinPlate},
                          {"one bright voxel", oneBrightVoxel},
                          {"one voxel thick", oneVoxelThick},
                          {"step on a plateau", stepOnAPlateau},
                          {"many points", manyPoints},
                          {"points an ulp apart", pointsAnUlpApart},
                          {"long voxels", longVoxels},
                          {"voxels of 1e-4 mm", smallVoxels},
                          {"voxels of 1e4 mm", largeVoxels},
                          {"sheared voxels", shearedVoxels},
                          {"1e7 mm off", farOrigin},
                          {"values an ulp apart", valuesAnUlpApart},
                          {"values about 1e6", farValues},
                          {"values about 1e29", hugeValues},
                          {"values about 1e-30", tinyValues},
                          {"outlier", outlier},
                          {"any unit distance", unitDistanceOfAnyPower},
                          {"opaque", opaque},
                          {"almost nothing", almostNothing},
                          {"narrow gradient opacity", narrowGradientOpacity},
                          {"sharp highlight", sharpHighlight},
                          {"many lights", manyLights},
                          {"low gradient floor", lowGradientFloor},
                          {"eye inside", eyeInside},
                          {"nearly along an axis", nearlyAlongAnAxis},
                          {"close-up", closeUp},
                          {"thin slab", thinSlab},
                          {"wedge", wedge}};

}  // namespace

RandomCase randomAttack(Chance chance) {
  RandomCase c;
  if (chance.oneIn(4)) return randomLattice(chance);
  const Kind& kind = kinds[chance.below(std::size(kinds))];
  c.what = kind.name;
  c.scene.mode = chance.oneIn(2) ? Mode::composite : randomMode(chance);
  c.size = randomPictureSize(chance);
  kind.make(chance, c);
  return c;
}

}  // namespace volumen::tests
