#pragma once

#include <QTest>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tests/fixtures/small_volumes.h"
#include "viewer/reference/reference.h"

namespace volumen::tests {

/// 0.01/255: five times tighter than the reference's promise. It allows for the reference's tolerance (1e-5
/// of a pixel) and for rounding of the float picture (6e-8).
constexpr double referenceBound = 0.01 / 255;

/// Returns a grid with the steps `L` (mm), centred on the origin of patient space.
inline VoxelGeometry gridAround(glm::ivec3 size, const glm::dmat3& L = glm::dmat3(1)) {
  VoxelGeometry geometry{.size = size, .patientFromVoxelStep = L};
  geometry.origin = -geometry.centre();
  return geometry;
}

/// Returns a volume of float32 samples valueAt(i, j, k).
template <class Function>
VolumePtr volumeOf(const VoxelGeometry& geometry, Function valueAt) {
  std::vector<float> values;
  for (int k = 0; k < geometry.size.z; ++k)
    for (int j = 0; j < geometry.size.y; ++j)
      for (int i = 0; i < geometry.size.x; ++i) values.push_back(float(valueAt(i, j, k)));
  VolumeParts parts;
  parts.geometry = geometry;
  parts.values = std::move(values);
  return volumeFrom(std::move(parts));
}

inline VolumePtr homogeneous(const VoxelGeometry& geometry, double value = 1) {
  return volumeOf(geometry, [=](int, int, int) { return value; });
}

/// Returns an unlit scene of one colour and opacity on a transparent background. It looks along `direction`
/// through the origin, and the picture is 1 mm high.
inline Scene plainScene(double opacity, glm::dvec3 direction = {1, 0, 0}) {
  Scene scene;
  scene.transferFunction.points = {{0, {1, 0.5, 0.25}, opacity}};
  scene.shading.lit = false;
  scene.background.transparent = true;
  Camera camera;
  camera.target = glm::dvec3(0);
  camera.direction = direction;
  camera.up =
      std::abs(direction.z) < 0.9 * glm::length(direction) ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  camera.height = 1;
  scene.camera = camera;
  scene.window = Window{0.5, 1};
  return scene;
}

inline Picture drawn(const Scene& scene, const Volume& volume, glm::ivec2 size = {1, 1}, int threads = 1) {
  return *renderReference(scene, volume, size, threads);
}

/// Returns the pixel of a picture of one pixel: the ray through the camera's target.
inline glm::dvec4 onePixel(const Scene& scene, const Volume& volume) {
  const Picture picture = drawn(scene, volume);
  return {picture.rgba[0], picture.rgba[1], picture.rgba[2], picture.rgba[3]};
}

/// Returns the extinction per mm of an opacity per mm.
inline double extinction(double opacity) { return -std::log1p(-opacity); }

/// Clips the parts affected by clamping at the border: the outermost full cell and the half voxel on each
/// side.
inline Clip insideOf(glm::ivec3 size) { return {1.5 / glm::dvec3(size), 1.0 - 1.5 / glm::dvec3(size), {}}; }

/// A volume of i^2 / 2, for which Sobel's central difference is exact, seen along x = -4 .. 4 (mm from the
/// parabola's vertex). On the ray |g| = |x|. Matter is white, and light comes from the viewer without
/// highlight.
struct Parabola {
  VolumePtr volume;
  Scene scene;
  double mu;
};
inline Parabola parabola(double opacity, int sides, double floorPerMm) {
  const VoxelGeometry geometry = gridAround({11, 5, 5});
  Parabola p{volumeOf(geometry, [](int i, int, int) { return (i - 5) * (i - 5) / 2.0; }), plainScene(opacity),
             0};
  p.scene.clip = insideOf(geometry.size);
  p.scene.transferFunction.points[0].colour = glm::dvec3(1);
  p.scene.shading = {true, sides, false, floorPerMm, 0.2, 0.7, 0, 20};
  p.mu = extinction(opacity);
  return p;
}

/// Returns the integral of (a + b x) mu exp(-mu x) over 0 .. length.
inline double attenuatedLine(double a, double b, double mu, double length) {
  const double e = std::exp(-mu * length);
  return a * (1 - e) + b * (1 / mu - e * (length + 1 / mu));
}

}  // namespace volumen::tests

/// Fails if two numbers differ by more than `bound`, and prints both.
#define COMPARE_WITHIN(actual, expected, bound)                                                          \
  do {                                                                                                   \
    const double got = (actual), wanted = (expected);                                                    \
    QVERIFY2(std::abs(got - wanted) <= (bound),                                                          \
             qPrintable(QStringLiteral("got %1, not %2").arg(got, 0, 'g', 10).arg(wanted, 0, 'g', 10))); \
  } while (false)
