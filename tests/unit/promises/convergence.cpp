#include "tests/unit/promises/convergence.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <stdexcept>

#include "tests/fixtures/brute_force.h"
#include "tests/fixtures/brute_matter.h"
#include "tests/fixtures/small_volumes.h"
#include "viewer/reference/reference.h"

namespace volumen::tests {
namespace {

using glm::dvec3;

constexpr double edgeMm = 12, clipShare = 0.15;

double softSphere(dvec3 p) {
  const dvec3 fromCentre = p + 20.0 * dvec3(0.36, -0.8, 0.48);
  return 500 * std::erfc((glm::length(fromCentre) - 20) / (0.6 * glm::root_two<double>()));
}

double marschnerLobb(dvec3 p) {
  const dvec3 x = (p + dvec3(11, 6, 3)) / 20.0;
  const double pi = glm::pi<double>();
  const double rings = std::cos(2 * pi * 6 * std::cos(pi / 2 * std::hypot(x.x, x.y)));
  return (1 - std::sin(pi / 2 * x.z) + 0.25 * (1 + rings)) / 2.5;
}

double ramp(dvec3 p) { return p.x + edgeMm / 2; }

/// Returns the gradient by central differences, in value per mm.
dvec3 gradientOf(const Field& field, dvec3 pMm) {
  constexpr double differenceMm = 1e-4;
  dvec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    dvec3 aside(0);
    aside[axis] = differenceMm;
    gradient[axis] = (field.value(pMm + aside) - field.value(pMm - aside)) / (2 * differenceMm);
  }
  return gradient;
}

Picture drawn(RenderCaches& caches, const Scene& scene, RenderOptions options, glm::ivec2 size) {
  options.size = size;
  const auto plan = makePlan(scene, caches.facts(), options);
  if (!plan) throw std::runtime_error(plan.message());
  auto rendered = render(*plan, caches);
  if (!rendered) throw std::runtime_error(rendered.message());
  return rendered->picture;
}

/// Interpolates `coarse` bilinearly at the pixel centres of a picture `size` pixels wide and high.
Picture bilinear(const Picture& coarse, int size) {
  Picture out{glm::ivec2(size), coarse.transparent, std::vector<float>(std::size_t(4) * size * size)};
  const int n = coarse.size.x;
  const auto at = [&](int pixel, int& low, double& f) {
    const double x = std::clamp((pixel + 0.5) / size * n - 0.5, 0.0, n - 1.0);
    low = std::min(int(x), n - 2);
    f = x - low;
  };
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      int i, j;
      double fx, fy;
      at(x, i, fx), at(y, j, fy);
      for (int c = 0; c < 4; ++c) {
        const auto value = [&](int dx, int dy) { return double(coarse.row(j + dy)[4 * (i + dx) + c]); };
        out.row(y)[4 * x + c] =
            float(between(between(value(0, 0), value(1, 0), fx), between(value(0, 1), value(1, 1), fx), fy));
      }
    }
  return out;
}

}  // namespace

const std::vector<Field>& closedFormFields() {
  static const std::vector<Field> fields = {
      {"marschner-lobb",
       marschnerLobb,
       {{0, {0.2, 0.3, 0.9}, 0}, {0.4f, {0.9, 0.5, 0.2}, 0.1}, {1, {1, 1, 0.8}, 0.4}},
       0.05,
       0.5},
      {"soft-sphere",
       softSphere,
       {{0, {0.2, 0.3, 0.9}, 0}, {400, {0.9, 0.5, 0.2}, 0.1}, {1000, {1, 1, 0.8}, 0.3}},
       20,
       0.5},
      {"ramp",
       ramp,
       {{0, {0.2, 0.3, 0.9}, 0}, {4.2f, {0.9, 0.5, 0.2}, 0.1}, {12, {1, 1, 0.8}, 0.4}},
       0.5,
       2}};
  return fields;
}

VolumePtr sampledField(const Field& field, double hMm) {
  const int n = int(std::lround(edgeMm / hMm));
  return volumeOf(glm::ivec3(n), glm::dmat3(hMm),
                  [&](dvec3 x) { return field.value((x - (n - 1) / 2.0) * hMm); });
}

Scene sceneOf(const Field& field, bool lit, double pictureMm) {
  Scene scene;
  scene.transferFunction.points = field.curve;
  scene.shading.lit = lit;
  scene.shading.gradientFloor = field.gradientFloor;
  scene.lights = {{{-0.4, 0.5, 1}, Space::camera, {1, 0.9, 0.8}, 0.7, true}};
  scene.background.transparent = true;
  scene.clip.boxLow = dvec3(clipShare);
  scene.clip.boxHigh = dvec3(1 - clipShare);
  Camera camera;
  camera.target = dvec3(0);
  camera.direction = {0.13, 1, -0.07};
  camera.height = pictureMm;
  scene.camera = camera;
  return scene;
}

Picture pictureOfField(const Field& field, const Scene& scene, glm::ivec2 size) {
  constexpr double stepMm = 1.0 / 200;
  const VolumePtr unused = sampledField(field, edgeMm / 2);
  const BruteMatter matter(scene, *unused);
  const glm::dmat3 axes = axesOf(*scene.camera);
  const double pictureMm = scene.camera->height;
  const double half = (0.5 - clipShare) * edgeMm;
  Picture picture{size, true, std::vector<float>(std::size_t(4) * size.x * size.y)};
  for (int pixel = 0; pixel < size.x * size.y; ++pixel) {
    const double a = ((pixel % size.x + 0.5) / size.x - 0.5) * pictureMm * size.x / size.y;
    const double b = (0.5 - (pixel / size.x + 0.5) / size.y) * pictureMm;
    const dvec3 q = a * axes[0] + b * axes[1], d = axes[2];
    double t0 = -edgeMm, t1 = edgeMm;
    for (int axis = 0; axis < 3; ++axis) {
      const double u = (-half - q[axis]) / d[axis], v = (half - q[axis]) / d[axis];
      t0 = std::max(t0, std::min(u, v));
      t1 = std::min(t1, std::max(u, v));
    }
    const int steps = int(std::ceil((t1 - t0) / stepMm));
    const double mm = (t1 - t0) / steps;
    dvec3 colour(0);
    double depth = 0;
    for (int n = 0; n < steps; ++n) {
      const dvec3 p = q + (t0 + (n + 0.5) * mm) * d;
      const Matter m = matter.classify(field.value(p));
      dvec3 shaded = m.colour;
      if (scene.shading.lit) shaded = matter.shade(m.colour, gradientOf(field, p), -d);
      const double more = matter.extinction(m.opacity) * mm;
      colour += shaded * (std::exp(-depth) * -std::expm1(-more));
      depth += more;
    }
    for (int c = 0; c < 3; ++c) picture.rgba[std::size_t(4) * pixel + c] = float(std::min(1.0, colour[c]));
    picture.rgba[std::size_t(4) * pixel + 3] = float(-std::expm1(-depth));
  }
  return picture;
}

std::vector<ErrorAt> errorOverStep(const Field& field, bool lit, const RenderOptions& options) {
  const glm::ivec2 size(16, 16);
  RenderCaches caches(sampledField(field, field.stepGridMm));
  const Scene scene = sceneOf(field, lit);
  const Picture limit = bruteForceLimit(scene, *caches.volume(), size, 1.0 / 256);
  std::vector<ErrorAt> errors;
  for (double step : {2.0, 1.0, 1.0 / 2, 1.0 / 4, 1.0 / 8, 1.0 / 16, 1.0 / 32}) {
    RenderOptions asked = options;
    asked.step = step;
    errors.push_back({step, compare(drawn(caches, scene, asked, size), limit)});
  }
  return errors;
}

std::vector<ErrorAt> errorOverGrid(const Field& field, bool lit) {
  const glm::ivec2 size(10, 10);
  const Scene scene = sceneOf(field, lit);
  const Picture truth = pictureOfField(field, scene, size);
  std::vector<ErrorAt> errors;
  for (double h : {1.0 / 2, 1.0 / 4, 1.0 / 8})
    errors.push_back({h, compare(*renderReference(scene, *sampledField(field, h), size), truth)});
  return errors;
}

std::vector<ErrorAt> errorOverPixel(const Field& field, bool lit, const RenderOptions& options) {
  constexpr int finest = 96, coarsest = 6;
  constexpr double pictureMm = 1.5;
  RenderCaches caches(sampledField(field, 1.0 / 8));
  const Scene scene = sceneOf(field, lit, pictureMm);
  RenderOptions truth;
  truth.method = Method::reference;
  const Picture reference = drawn(caches, scene, truth, glm::ivec2(finest));
  // Bilinear interpolation is undefined beyond the outermost pixel centres of the coarsest picture.
  std::vector<std::uint8_t> inside(std::size_t(finest) * finest);
  const int border = finest / coarsest / 2;
  for (int y = border; y < finest - border; ++y)
    for (int x = border; x < finest - border; ++x) inside[std::size_t(y) * finest + x] = 1;
  std::vector<ErrorAt> errors;
  for (int n = coarsest; n < finest; n *= 2)
    errors.push_back({pictureMm / n, compare(bilinear(drawn(caches, scene, options, glm::ivec2(n)), finest),
                                             reference, inside)});
  return errors;
}

double slopeOf(const std::vector<ErrorAt>& errors) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = double(errors.size());
  for (const ErrorAt& e : errors) {
    const double x = std::log2(e.h), y = std::log2(e.error.rmse);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace volumen::tests
