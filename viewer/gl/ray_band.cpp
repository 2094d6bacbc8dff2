#include "viewer/gl/ray_band.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr int texelsARay = 4;

}  // namespace

int RayBands::rows() const {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  constexpr std::int64_t samples = 1 << 27;
  const std::int64_t pixels = std::min<std::int64_t>({1 << 19, most / texelsARay, samples / drawnSteps_});
  return int(std::clamp<std::int64_t>(pixels / (size_.x + RayGenerator::padding), 1, size_.y));
}

void RayBands::fill(RayBand& band, int threads) {
  band.rows.resize(std::min(rows(), size_.y - next_));
  band.longest = 0;
  if (band.empty()) return;
  parallelFor(std::int64_t(band.rows.size()), threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) setup_.makeRays(0, next_ + int(n), size_.x, band.rows[n]);
  });
  next_ += int(band.rows.size());
  band.stride = int(band.rows.front().steps.size());
  for (const RayRow& r : band.rows)
    band.longest = std::max(band.longest, *std::max_element(r.steps.begin(), r.steps.end()));
}

Status uploadRays(const RayBand& band, float inverseUnitMm, BufferTexture& to) {
  std::vector<float> texels;
  texels.reserve(std::size_t(4) * texelsARay * band.stride * band.rows.size());
  for (const RayRow& r : band.rows)
    for (int n = 0; n < band.stride; ++n)
      texels.insert(texels.end(),
                    {r.startX[n], r.startY[n], r.startZ[n], r.lastMiddle[n], r.moveX[n], r.moveY[n],
                     r.moveZ[n], float(r.steps[n]), r.viewerX[n], r.viewerY[n], r.viewerZ[n], 0.0f,
                     r.stepMm[n] * inverseUnitMm, r.lastStepMm[n] * inverseUnitMm, 0.0f, 0.0f});
  return to.upload(GL_RGBA32F, 16, texels);
}

}  // namespace volumen
