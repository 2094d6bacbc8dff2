#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/brute_force.h"
#include "tests/fixtures/small_volumes.h"

/// Shared parts of the closed forms that the brute-force renderer is compared with.
namespace volumen::tests::closed_forms {

inline const glm::dmat3 unitSteps(1);
inline const glm::dmat3 sheared({1, 0, 0}, {0, 1, 0}, {0, 0.5, 2});

/// Returns an unlit scene of one colour and opacity on a transparent background, seen from the front.
inline Scene plainScene(glm::dvec3 colour, double opacity) {
  Scene scene;
  scene.transferFunction.points = {{0, colour, opacity}};
  scene.shading.lit = false;
  scene.background.transparent = true;
  scene.camera.emplace().height = 1;
  return scene;
}

/// Returns a component of a pixel.
inline double pixel(const Picture& picture, int x, int y, int component) {
  return picture.row(y)[4 * x + component];
}

/// Returns the pixel of a picture of one pixel.
inline std::vector<double> onePixel(const Picture& picture) {
  return {picture.rgba[0], picture.rgba[1], picture.rgba[2], picture.rgba[3]};
}

/// Returns whether two values differ by at most the bound.
inline bool near(double a, double b, double bound) { return std::abs(a - b) <= bound; }

}  // namespace volumen::tests::closed_forms
