#include "viewer/reference/reference.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "viewer/reference/integral.h"
#include "viewer/reference/surfaces.h"
#include "viewer/scene/modes.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

using namespace reference;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Casts the rays of a picture; holds what they share.
class Caster {
 public:
  Caster(const Scene& scene, const Volume& volume, glm::ivec2 size)
      : scene_(scene),
        volume_(volume),
        rays_(*scene.camera, volume.geometry(), size),
        classifier_(scene.transferFunction, volume.geometry()),
        lighting_(scene, rays_.axes()),
        surfaces_(scene, volume.geometry()) {}

  /// Returns the float pixel (picture.md 6, design.md 10), with its ray moved sideways by `moveMm` along the
  /// picture's right and up.
  glm::vec4 pixel(int px, int py, glm::dvec2 moveMm = {0, 0}) const {
    Ray ray = rays_.through(px, py);
    ray.origin += moveMm.x * rays_.axes().right + moveMm.y * rays_.axes().up;
    const Interval interval = visibleInterval(ray, volume_.geometry(), scene_.clip);
    if (scene_.mode == Mode::composite) return composite(ray, interval);
    if (interval.empty()) return composed(glm::dvec3(0), 0);
    return composed(glm::dvec3(projectedGrey(ray, interval)), 1);
  }

  /// Returns true if the pixel is well-conditioned (design.md 2). `here`: its reference.
  bool isWellConditioned(int px, int py, glm::vec4 here) const {
    const glm::dvec2 move = sidewaysMm();
    const glm::dvec2 moves[] = {{move.x, 0}, {-move.x, 0}, {0, move.y}, {0, -move.y}};
    return std::all_of(std::begin(moves), std::end(moves), [&](glm::dvec2 by) {
      const glm::vec4 change = glm::abs(pixel(px, py, by) - here);
      return std::max({change.r, change.g, change.b, change.a}) <= 0.1f / 255;
    });
  }

 private:
  /// Returns the length in mm of 1e-4 voxel along the picture's right and up.
  glm::dvec2 sidewaysMm() const {
    const glm::dmat3 voxelFromMm = volume_.geometry().voxelFromPatientStep();
    return 1e-4 / glm::dvec2(glm::length(voxelFromMm * rays_.axes().right),
                             glm::length(voxelFromMm * rays_.axes().up));
  }

  glm::vec4 composite(const Ray& ray, Interval interval) const {
    Lighting lighting = lighting_;
    if (scene_.shading.localViewer) lighting.setViewer(-ray.direction);
    RayIntegral integral(volume_, classifier_, lighting);
    bool goesOn = true;
    const auto addUpTo = [&](double end) {
      const Interval part{interval.t0, std::min(end, interval.t1)};
      if (!part.empty())
        marchCells(volume_.geometry(), ray, part,
                   [&](const CellPiece& p) { return goesOn = integral.add(p); });
      interval.t0 = std::max(interval.t0, end);
    };
    for (const SurfaceCrossing& s : surfaces_.along(ray, lighting)) {
      addUpTo(s.t);
      goesOn = goesOn && integral.cover(s.colour, s.opacity);
      if (!goesOn) break;
    }
    if (goesOn) addUpTo(infinity);
    return composed(integral.colour(), 1 - integral.transmittance());
  }

  double projectedGrey(const Ray& ray, Interval interval) const {
    const auto projection = rowOf(scene_.mode).project();
    std::vector<double> places;
    marchCells(volume_.geometry(), ray, interval, [&](const CellPiece& p) {
      const Corners<double> corners = cornerValues(volume_, p.cell);
      const Cubic v = interpolateAlong(corners, p.start, p.move);
      ValuesInCell values{v.c, infinity, -infinity, p.lengthMm};
      places.assign({0, 1});
      appendExtremes(v, places);
      for (double s : places) {
        const double value = interpolateAt(corners, p.start + s * p.move);
        values.largest = std::max(values.largest, value);
        values.smallest = std::min(values.smallest, value);
      }
      projection->add(values);
      return true;
    });
    const double value = projection->value(interval.t1 - interval.t0);
    const Window& window = *scene_.window;
    return std::clamp((value - (window.centre - window.width / 2)) / window.width, 0.0, 1.0);
  }

  glm::vec4 composed(glm::dvec3 colour, double alpha) const {
    const Background& background = scene_.background;
    if (!background.transparent) {
      colour += (1 - alpha) * background.colour;
      alpha = 1;
    }
    return glm::vec4(glm::clamp(colour, 0.0, 1.0), alpha);
  }

  const Scene& scene_;
  const Volume& volume_;
  RayMaker rays_;
  Classifier classifier_;
  Lighting lighting_;
  Surfaces surfaces_;
};

// Calls row(y) for all rows. The results of a row do not depend on its thread.
template <class Row>
Status forEachRow(int rows, int threads, const CancelToken& cancel, Row row) {
  parallelFor(rows, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto y = int(first); y < int(last) && !cancel.cancelled(); ++y) row(y);
  });
  if (cancel.cancelled()) return Error{"cancelled"};
  return {};
}

void assertComplete([[maybe_unused]] const Scene& scene) {
  assert(scene.camera && (scene.mode == Mode::composite || scene.window));
}

}  // namespace

Result<Picture> renderReference(const Scene& scene, const Volume& volume, glm::ivec2 size, int threads,
                                const CancelToken& cancel) {
  assertComplete(scene);
  const Caster caster(scene, volume, size);
  Picture picture{size, scene.background.transparent, std::vector<float>(std::size_t(4) * size.x * size.y)};
  const Status done = forEachRow(size.y, threads, cancel, [&](int y) {
    for (int x = 0; x < size.x; ++x) {
      const glm::vec4 pixel = caster.pixel(x, y);
      std::copy_n(&pixel[0], 4, picture.row(y) + 4 * x);
    }
  });
  if (!done) return done.error();
  return picture;
}

Result<std::vector<std::uint8_t>> wellConditioned(const Scene& scene, const Volume& volume, glm::ivec2 size,
                                                  int threads, const CancelToken& cancel) {
  assertComplete(scene);
  const Caster caster(scene, volume, size);
  std::vector<std::uint8_t> well(std::size_t(size.x) * size.y);
  const Status done = forEachRow(size.y, threads, cancel, [&](int y) {
    for (int x = 0; x < size.x; ++x)
      well[std::size_t(y) * size.x + x] = caster.isWellConditioned(x, y, caster.pixel(x, y));
  });
  if (!done) return done.error();
  return well;
}

Result<ReferencePixels> referencePixels(const Scene& scene, const Volume& volume, glm::ivec2 size,
                                        const std::vector<glm::ivec2>& pixels, int threads,
                                        const CancelToken& cancel) {
  assertComplete(scene);
  const Caster caster(scene, volume, size);
  ReferencePixels out;
  out.rgba.resize(pixels.size());
  out.well.resize(pixels.size());
  const Status done = forEachRow(int(pixels.size()), threads, cancel, [&](int n) {
    out.rgba[n] = caster.pixel(pixels[n].x, pixels[n].y);
    out.well[n] = caster.isWellConditioned(pixels[n].x, pixels[n].y, out.rgba[n]);
  });
  if (!done) return done.error();
  return out;
}

}  // namespace volumen
