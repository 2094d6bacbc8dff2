#include "viewer/evaluation/truth.h"

#include <algorithm>
#include <cmath>

#include "viewer/evaluation/statistics.h"
#include "viewer/reference/reference.h"
#include "viewer/volume/clock.h"

namespace volumen {

namespace {

// Returns thoroughly mixed bits of a cell's number (the finaliser of SplitMix64).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

glm::vec4 pixelOf(const Picture& picture, int x, int y) {
  const float* p = picture.row(std::clamp(y, 0, picture.size.y - 1)) +
                   std::size_t(4) * std::clamp(x, 0, picture.size.x - 1);
  return {p[0], p[1], p[2], p[3]};
}

// Pixels are squares of height / H mm around the middle of the picture (picture.md 7).
glm::vec4 enlarged(const Picture& small, glm::ivec2 size, glm::ivec2 pixel) {
  const double scale = double(small.size.y) / size.y;
  const glm::dvec2 at =
      (glm::dvec2(pixel) + 0.5 - glm::dvec2(size) / 2.0) * scale + glm::dvec2(small.size) / 2.0 - 0.5;
  const int x = int(std::floor(at.x)), y = int(std::floor(at.y));
  const float fx = float(at.x - x), fy = float(at.y - y);
  const auto mix = [](glm::vec4 a, glm::vec4 b, float f) { return a + f * (b - a); };
  return mix(mix(pixelOf(small, x, y), pixelOf(small, x + 1, y), fx),
             mix(pixelOf(small, x, y + 1), pixelOf(small, x + 1, y + 1), fx), fy);
}

}  // namespace

std::size_t Truth::illConditioned() const { return std::size_t(std::count(well.begin(), well.end(), 0)); }

void choosePixels(Truth& truth, glm::ivec2 size, int most) {
  truth.size = truth.grid = size;
  if (std::int64_t(size.x) * size.y > most) {
    const double shrink = std::sqrt(double(most) / (double(size.x) * size.y));
    truth.grid = glm::max(glm::ivec2(1), glm::ivec2(glm::floor(glm::dvec2(size) * shrink)));
    truth.grid = glm::min(truth.grid, most / glm::ivec2(truth.grid.y, truth.grid.x));
  }
  truth.pixels.clear();
  for (int y = 0; y < truth.grid.y; ++y)
    for (int x = 0; x < truth.grid.x; ++x) {
      const std::uint64_t chance = mixed(truth.pixels.size());
      const auto inside = [](int cell, int cells, int pixels, std::uint64_t random) {
        const int begin = int(std::int64_t(cell) * pixels / cells),
                  end = int(std::int64_t(cell + 1) * pixels / cells);
        return begin + int(random % std::uint64_t(end - begin));
      };
      truth.pixels.emplace_back(inside(x, truth.grid.x, size.x, chance & 0xffffffff),
                                inside(y, truth.grid.y, size.y, chance >> 32));
    }
}

Result<Truth> makeTruth(const Scene& complete, const Volume& volume, glm::ivec2 size, int mostPixels,
                        int threads, const StudyProgress& progress, const CancelToken& cancel) {
  Truth truth;
  choosePixels(truth, size, mostPixels);
  truth.picture = {truth.grid, complete.background.transparent, {}};
  const double begin = wallMs();
  constexpr std::size_t batch = 512;
  for (std::size_t n = 0; n < truth.pixels.size(); n += batch) {
    if (progress) progress("computing the reference", n, truth.pixels.size());
    const auto first = truth.pixels.begin() + std::ptrdiff_t(n),
               last = truth.pixels.begin() + std::ptrdiff_t(std::min(n + batch, truth.pixels.size()));
    const auto part = referencePixels(complete, volume, size, {first, last}, threads, cancel);
    if (!part) return part.error();
    for (const glm::vec4& p : part->rgba)
      truth.picture.rgba.insert(truth.picture.rgba.end(), &p[0], &p[0] + 4);
    truth.well.insert(truth.well.end(), part->well.begin(), part->well.end());
  }
  truth.ms = wallMs() - begin;
  return truth;
}

Picture atPixelsOf(const Truth& truth, const Picture& picture) {
  Picture out{truth.grid, picture.transparent, {}};
  out.rgba.reserve(4 * truth.pixels.size());
  for (const glm::ivec2 pixel : truth.pixels) {
    const glm::vec4 p = picture.size == truth.size ? pixelOf(picture, pixel.x, pixel.y)
                                                   : enlarged(picture, truth.size, pixel);
    out.rgba.insert(out.rgba.end(), &p[0], &p[0] + 4);
  }
  return out;
}

}  // namespace volumen
