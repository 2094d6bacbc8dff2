// Hard curves: coincident points, peaks between samples, surfaces, the limits of floats.
#include <cmath>

#include "tests/unit/hard/hard_cases.h"

namespace volumen::tests {
namespace {

using glm::dvec3;
using glm::dvec4;

/// Adds a curve over two volumes: a ramp of 100 a mm along y, seen along y, and waves of 0 .. 1000, seen
/// obliquely.
void addOverBoth(HardCases& cases, const std::string& name, const std::vector<CurvePoint>& points) {
  const VolumePtr ramp = rampVolume(), wavy = wavesVolume();
  cases.addBoth({.name = name + ", over a ramp",
                 .volume = ramp,
                 .scene = sceneOf(*ramp, points, {0, 1, 0}),
                 .delicate = true});
  cases.addBoth({.name = name + ", over waves", .volume = wavy, .scene = sceneOf(*wavy, points)});
}

/// Returns a triangular peak of height `opacity` and base width 10. Voxels differ by 100.
std::vector<CurvePoint> peak(double opacity) {
  return {{545, {1, 0.6, 0.3}, 0}, {550, {1, 0.6, 0.3}, opacity}, {555, {1, 0.6, 0.3}, 0}};
}

/// Closed form of crossing a peak in a straight line: mu integrated over the triangle, with sides 5 / 100 mm
/// long.
HardCase peakWithClosedForm(double opacity) {
  const VolumePtr ramp = rampVolume();
  HardCase c{
      .name = "peak of a tenth of a voxel, opacity " + std::to_string(opacity).substr(0, 4) + ", unlit",
      .volume = ramp,
      .scene = sceneOf(*ramp, peak(opacity), {0, 1, 0}),
      .delicate = true};
  c.scene.shading.lit = false;
  c.scene.background.transparent = true;
  c.scene.camera->height = 10;  // every ray passes all of the ramp
  // The integral of -ln(1 - o) for o = 0 .. opacity over one side.
  const double side = 0.05 * ((1 - opacity) * std::log1p(-opacity) + opacity) / opacity;
  c.closedForm = [=](double) {
    const double alpha = -std::expm1(-2 * side);
    return dvec4(dvec3(1, 0.6, 0.3) * alpha, alpha);
  };
  return c;
}

std::vector<CurvePoint> zigzag() {
  std::vector<CurvePoint> points;
  for (int n = 0; n < 256; ++n)
    points.push_back({float(4 * n), {n % 2 * 1.0, n % 3 / 2.0, n % 5 / 4.0}, n % 4 == 3 ? 0.4 : 0.01});
  return points;
}

}  // namespace

void addCurveCases(HardCases& cases) {
  cases.add(peakWithClosedForm(0.3));
  cases.add(peakWithClosedForm(0.95));
  addOverBoth(cases, "peak of a tenth of a voxel, opacity 0.6", peak(0.6));
  addOverBoth(cases, "peak of a tenth of a voxel, opacity 1", peak(1));
  addOverBoth(cases, "two points at one value", {{500, {1, 0.5, 0.3}, 0}, {500, {1, 0.5, 0.3}, 0.3}});
  addOverBoth(cases, "three points at one value",
              {{500, {1, 0.5, 0.3}, 0.02}, {500, {0, 0, 1}, 1}, {500, {0.3, 0.9, 0.5}, 0.3}});
  addOverBoth(cases, "opaque above a value", {{500, {1, 0.5, 0.3}, 0}, {500, {1, 0.5, 0.3}, 1}});
  addOverBoth(cases, "opaque below a value", {{500, {1, 0.5, 0.3}, 1}, {500, {1, 0.5, 0.3}, 0}});
  addOverBoth(cases, "opacity from 0 to 1 over one unit",
              {{499.5f, {1, 0.5, 0.3}, 0}, {500.5f, {1, 0.9, 0.3}, 1}});
  addOverBoth(cases, "opacity just short of 1 growing to 1",
              {{300, {1, 0.5, 0.3}, 0}, {700, {1, 0.9, 0.3}, 1 - 1e-6}, {900, {0.3, 0.5, 1}, 1}});
  addOverBoth(cases, "colours jump where the opacity does not",
              {{500, {1, 0, 0}, 0.1}, {500, {0, 1, 0}, 0.1}, {700, {0, 1, 0}, 0.1}, {700, {0, 0, 1}, 0.1}});
  addOverBoth(cases, "256 points in a zigzag", zigzag());
  addOverBoth(cases, "points at both ends of floats",
              {{-3e38f, {1, 0, 0}, 0}, {400, {1, 0.5, 0.3}, 0.02}, {3e38f, {0, 0, 1}, 0.02}});
  addOverBoth(cases, "all values far from both points of the curve",
              {{-1e38f, {1, 0.5, 0.3}, 0}, {3e38f, {0.3, 0.5, 1}, 0.2}});
  addOverBoth(cases, "points one float apart",
              {{500, {1, 0.5, 0.3}, 0}, {std::nextafter(500.0f, 501.0f), {0.5, 1, 0.3}, 0.5}});
}

}  // namespace volumen::tests
