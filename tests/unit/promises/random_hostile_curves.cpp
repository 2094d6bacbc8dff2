// Kinds of the family "hostile": curves with narrow peaks, steps and combs, and gradient opacities.
#include <algorithm>
#include <cmath>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/promises/random_hostile.h"

namespace volumen::tests::hostile {
namespace {

using glm::dmat3;
using glm::dvec3;
using glm::ivec3;

/// Returns a value in HU that tissue, the edge of bone or lung has.
double anyHu(Chance& chance) {
  constexpr ValueRange places[] = {{-150, 200}, {-150, 200}, {-950, -200}, {200, 1600}};
  const ValueRange range = places[chance.below(4)];
  return chance.between(range.low, range.high);
}

/// Returns a peak of this width on a base of this opacity.
std::vector<CurvePoint> peak(double at, double wide, CurvePoint base, CurvePoint top) {
  std::vector<CurvePoint> points{base, top, base};
  points[0].value = float(at - wide / 2);
  points[1].value = float(at);
  points[2].value = float(at + wide / 2);
  return points;
}

void narrowPeak(Chance& chance, RandomCase& c) {
  aroundCt(chance, c, chance.power(0, 2));
  const double at = anyHu(chance), wide = chance.between(1, 15), opacity = chance.between(0.1, 1);
  const dvec3 colour = chance.colour();
  const double base = chance.oneIn(2) ? 0 : chance.power(-4, -1);
  c.scene.transferFunction.points = peak(at, wide, {0, colour, base}, {0, chance.colour(), opacity});
  c.scene.transferFunction.unitDistance = chance.power(-1.5, 1);
}

void twoPeaks(Chance& chance, RandomCase& c) {
  aroundCt(chance, c, chance.power(0, 2));
  const double at = anyHu(chance), wide = chance.between(1, 15), opacity = chance.between(0.1, 0.95);
  std::vector<CurvePoint> points = peak(at, wide, {}, {0, dvec3(0), opacity});
  for (const CurvePoint& p : peak(at + wide, wide, {}, {0, dvec3(1), opacity})) points.push_back(p);
  c.scene.transferFunction.points = points;
  c.scene.transferFunction.unitDistance = chance.power(-1.5, 0.5);
  c.scene.shading.lit = chance.oneIn(3);
}

void notch(Chance& chance, RandomCase& c) {
  aroundCt(chance, c, chance.power(0, 2));
  const double at = anyHu(chance), wide = chance.between(1, 15), opacity = chance.between(0.1, 0.99);
  c.scene.transferFunction.points =
      peak(at, wide, {0, dvec3(1), opacity}, {0, dvec3(0), chance.oneIn(2) ? 0 : opacity});
  setDepth(c, opacity, chance.power(-0.3, 1.5));
}

void combOverCt(Chance& chance, RandomCase& c) {
  aroundCt(chance, c, chance.power(-1, 2));
  const int count = 10 + chance.below(191);
  const double opacity = chance.between(0.05, 0.9);
  const ValueRange range = chance.oneIn(2) ? rangeOf(c) : ValueRange{-200, 300};
  c.scene.transferFunction.points = anyComb(chance, range, count, opacity);
  setDepth(c, opacity, chance.power(-0.5, 1.3));
}

void combOverHill(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 16, 96);
  const ValueAt smooth = hill(size);
  around(chance, c, volumeOf(size, dmat3(1), [&](dvec3 x) { return 1000 * smooth(x); }));
  const int count = 10 + chance.below(191);
  const double opacity = chance.between(0.02, 0.9);
  c.scene.transferFunction.points = anyComb(chance, {0, 1000}, count, opacity);
  setDepth(c, opacity, chance.power(-0.5, 1));
  c.scene.shading.lit = chance.oneIn(3);
}

/// Adds a step at a value: two points that are equal, an ulp, or a small difference apart.
void addStep(Chance& chance, std::vector<CurvePoint>& points, float at, CurvePoint below, CurvePoint above) {
  below.value = above.value = at;
  if (chance.oneIn(3)) above.value = std::nextafter(at, 1e9f);
  if (chance.oneIn(3)) above.value = float(double(at) + chance.power(-4, 0));
  points.push_back(below);
  points.push_back(above);
}

void steps(Chance& chance, RandomCase& c) {
  aroundCt(chance, c, chance.power(-1, 2));
  std::vector<double> places;
  const int count = 1 + chance.below(5);
  for (int n = 0; n < count; ++n) places.push_back(std::round(anyHu(chance)));
  std::sort(places.begin(), places.end());
  std::vector<CurvePoint> points;
  CurvePoint above{0, chance.colour(), 0};
  for (double place : places) {
    const CurvePoint below = above;
    above.colour = chance.oneIn(2) ? dvec3(chance.below(2)) : chance.colour();
    above.opacity = chance.share();
    addStep(chance, points, float(place), below, above);
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const CurvePoint& a, const CurvePoint& b) { return a.value < b.value; });
  c.scene.transferFunction.points = points;
  setDepth(c, 0.5, chance.power(-0.5, 2));
}

void staircase(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 16, 72);
  const ValueAt smooth = chance.oneIn(2) ? hill(size) : ripples(chance, chance.between(6, 30), 4);
  around(chance, c, volumeOf(size, dmat3(1), [&](dvec3 x) { return 1000 * smooth(x); }));
  const int count = 10 + chance.below(91);
  const double most = chance.between(0.05, 0.95);
  const bool inTurn = chance.oneIn(2);
  std::vector<CurvePoint> points;
  for (int n = 0; n < count; ++n) {
    const CurvePoint below = points.empty() ? CurvePoint{} : points.back();
    const double opacity = inTurn ? most : most * (n + 1) / count;
    addStep(chance, points, float(n * 1000.0 / count), below, {0, dvec3(n % 2), opacity});
  }
  c.scene.transferFunction.points = points;
  setDepth(c, most, chance.power(-0.5, 1));
}

void opaqueAboveAStep(Chance& chance, RandomCase& c) {
  aroundCt(chance, c, chance.power(-1, 2));
  const double at = anyHu(chance), next = chance.power(0, 2.5);
  c.scene.transferFunction.points = {{float(at), dvec3(1), 0},
                                     {float(at), dvec3(0), 1},
                                     {float(at + next), dvec3(1), 1},
                                     {float(at + 2 * next), dvec3(0), 1}};
  c.scene.transferFunction.unitDistance = chance.power(-2, 1.5);
  c.scene.shading.lit = chance.oneIn(2);
}

/// The noise is far below or far above the distance of the curve's points.
void floatNoise(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 16, 72);
  const ValueAt smooth = ripples(chance, chance.between(8, 40), 4), grain = noise(chance);
  const double amplitude = 1000 * chance.power(-6, 0.5);
  around(chance, c,
         volumeOf(size, dmat3(1), [&](dvec3 x) { return 1000 * smooth(x) + amplitude * grain(x); }));
  const int count = 3 + chance.below(100);
  const double opacity = chance.power(-2, -0.1);
  c.scene.transferFunction.points = anyComb(chance, {200, 800}, count, opacity);
  setDepth(c, opacity, chance.power(-0.5, 1));
  if (chance.oneIn(3)) c.scene.shading.gradientFloor = amplitude * chance.power(-1, 0.5);
}

void faintComb(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 48, 96);
  const ValueAt smooth = ripples(chance, chance.between(6, 60), 3);
  around(chance, c, volumeOf(size, dmat3(1), [&](dvec3 x) { return 1000 * smooth(x); }));
  const double opacity = chance.power(-3, -1);
  const int count = 20 + chance.below(231);
  c.scene.transferFunction.points = anyComb(chance, {0, 1000}, count, opacity);
  setDepth(c, opacity, chance.power(-0.3, 0.7));
  c.scene.shading.lit = false;
}

/// Multiplies the opacity by a band, steps or a comb of gradients.
void addEdges(Chance& chance, Scene& scene, double gradient) {
  std::vector<GradientOpacityPoint>& points = scene.transferFunction.gradientOpacity;
  const double wide = gradient * chance.power(-3, -0.5);
  const int kind = chance.below(3);
  if (kind == 0) points = {{gradient, 0}, {gradient + wide, 1}, {gradient + 2 * wide, 0}};
  if (kind == 1) points = {{gradient, 0}, {gradient, 1}};
  if (kind == 2) {
    const int count = 10 + chance.below(200);
    for (int n = 0; n < count; ++n) points.push_back({2 * gradient * n / count, double(n % 2)});
  }
}

void edgesOfCt(Chance& chance, RandomCase& c) {
  aroundCt(chance, c, chance.power(-1, 2));
  addEdges(chance, c.scene, chance.power(1, 3));
  const double opacity = chance.between(0.1, 0.99);
  if (chance.oneIn(2))
    c.scene.transferFunction.points = {{-1000, dvec3(0), opacity}, {300, dvec3(1), opacity}};
  setDepth(c, opacity, chance.power(-0.3, 1.7));
}

void edgesOfRipples(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 16, 72);
  const double period = chance.between(3, 30);
  const ValueAt smooth = ripples(chance, period, 3);
  around(chance, c, volumeOf(size, dmat3(1), [&](dvec3 x) { return 1000 * smooth(x); }));
  addEdges(chance, c.scene, 1000 / period * chance.power(-1, 0.5));
  const double opacity = chance.between(0.05, 0.9);
  c.scene.transferFunction.points = {{300, dvec3(0), opacity}, {700, dvec3(1), opacity}};
  setDepth(c, opacity, chance.power(-0.3, 1.3));
}

void stepsOnVoxelValues(Chance& chance, RandomCase& c) {
  const ivec3 size = anySize(chance, 16, 48);
  const ValueAt smooth = ripples(chance, chance.between(5, 20), 3);
  const int levels = 2 + chance.below(8);
  around(chance, c,
         volumeOf<std::uint8_t>(size, dmat3(1), [&](dvec3 x) { return std::round(levels * smooth(x)); }));
  std::vector<CurvePoint> points;
  for (int n = 0; n < levels; ++n) {
    const CurvePoint below = points.empty() ? CurvePoint{} : points.back();
    points.insert(points.end(), {below, {0, chance.colour(), chance.share()}});
    points[points.size() - 2].value = points.back().value = float(n);
  }
  c.scene.transferFunction.points = points;
  if (chance.oneIn(2)) lookAlong(chance, c, nearly(chance, directionOfSmallNumbers(chance)));
}

constexpr Kind kindsOfCurves[] = {{"narrow peak in CT", narrowPeak},
                                  {"two narrow peaks in CT", twoPeaks},
                                  {"notch in CT", notch},
                                  {"comb over CT", combOverCt},
                                  {"comb over a hill", combOverHill},
                                  {"steps in CT", steps},
                                  {"staircase", staircase},
                                  {"opaque above a step", opaqueAboveAStep},
                                  {"float noise", floatNoise},
                                  {"faint comb", faintComb},
                                  {"edges of CT", edgesOfCt},
                                  {"edges of ripples", edgesOfRipples},
                                  {"steps on voxel values", stepsOnVoxelValues}};

}  // namespace

std::span<const Kind> curveKinds() { return kindsOfCurves; }

}  // namespace volumen::tests::hostile
