#include "viewer/methods/blend_gl.h"

#include <atomic>
#include <limits>

#include "viewer/kernels/shade_samples.h"
#include "viewer/methods/gl_band.h"
#include "viewer/methods/row_painter.h"
#include "viewer/volume/clock.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Computes the lengths, in unit distances (picture.md 9), of the n-th intervals of a row's rays; 0 for rays
// without one.
void unitDistancesOfSlice(const RayRow& rays, int n, float inverseUnitMm, std::vector<float>& unitDistances) {
  unitDistances.resize(rays.steps.size());
  // Branch-free, so that the compiler can vectorize it.
  const int* steps = rays.steps.data();
  const float *full = rays.stepMm.data(), *last = rays.lastStepMm.data();
  float* out = unitDistances.data();
  for (std::size_t ray = 0, count = unitDistances.size(); ray < count; ++ray) {
    const float whole = full[ray], rest = last[ray];
    const int left = steps[ray] - n;
    const float some = left > 1 ? whole : rest;
    out[ray] = (left > 0 ? some : 0.0f) * inverseUnitMm;
  }
}

// Shades a slice's samples for the frame buffer, four floats per pixel, on all cores.
class SliceShader {
 public:
  SliceShader(const Plan& plan, const RenderInputs& inputs)
      : plan_(plan), inputs_(inputs), shade_(chooseShadeKernel(inputs.key())) {}

  const float* shade(const RayBand& band, int n, const SampleTarget::Samples& samples) {
    const double begin = wallMs();
    const std::size_t stride = band.stride;
    rgba_.resize(4 * stride * band.rows.size());
    parallelFor(
        std::int64_t(band.rows.size()), plan_.options.threads, [&](std::int64_t first, std::int64_t last) {
          std::vector<float> unitDistances, values(4 * stride);
          for (std::int64_t row = first; row < last; ++row) {
            unitDistancesOfSlice(band.rows[row], n, inputs_.trace().inverseUnitMm, unitDistances);
            const float* density = samples.density + row * stride;
            const float* gradients = samples.gradients ? samples.gradients + 4 * row * stride : nullptr;
            float* out = &rgba_[4 * row * stride];
            if (plan_.scene.mode == Mode::composite)
              shadeRow(band.rows[row], density, gradients, unitDistances, values, out);
            else
              projectRow(density, unitDistances, out);
          }
        });
    ms_ += wallMs() - begin;
    return rgba_.data();
  }

  void report(RenderStats& stats) const {
    stats.shadeMs = ms_;
    stats.composited = visible_;
    stats.shaded = plan_.lit ? stats.composited : 0;
  }

 private:
  void shadeRow(const RayRow& rays, const float* density, const float* gradients,
                const std::vector<float>& unitDistances, std::vector<float>& values, float* rgba) {
    const TraceRow out = traceRowOf(values);
    visible_ += shade_(inputs_.trace(),
                       {int(unitDistances.size()), density, gradients, unitDistances.data(),
                        rays.viewerX.data(), rays.viewerY.data(), rays.viewerZ.data()},
                       out);
    for (std::size_t n = 0; n < unitDistances.size(); ++n, rgba += 4)
      rgba[0] = out.red[n], rgba[1] = out.green[n], rgba[2] = out.blue[n], rgba[3] = out.alpha[n];
  }

  // Writes densities for MAX and MIN; for averages density times length, and length.
  void projectRow(const float* density, const std::vector<float>& unitDistances, float* rgba) const {
    constexpr float most = std::numeric_limits<float>::max();
    const Mode mode = plan_.scene.mode;
    for (std::size_t n = 0; n < unitDistances.size(); ++n, rgba += 4) {
      const bool has = unitDistances[n] > 0;
      const float none = mode == Mode::mip ? -most : mode == Mode::minip ? most : 0;
      rgba[0] = !has ? none : mode == Mode::average ? density[n] * unitDistances[n] : density[n];
      rgba[1] = mode == Mode::average ? unitDistances[n] : 0;
      rgba[2] = rgba[3] = 0;
    }
  }

  const Plan& plan_;
  const RenderInputs& inputs_;
  ShadeKernel shade_;
  std::vector<float> rgba_;
  std::atomic<std::int64_t> visible_{0};
  double ms_ = 0;
};

// Draws all slices of a band from the back. While the CPU shades one, OpenGL draws the next.
Status drawSlices(const RayBand& band, SliceBlender& blender, SliceShader& shader,
                  const CancelToken& cancel) {
  for (int n = band.longest - 1; n >= -1; --n) {
    if (n >= 0) blender.drawSlice(n, n % 2);
    const int behind = n + 1;
    if (behind == band.longest) continue;
    const SampleTarget::Samples samples = blender.map(behind % 2);
    if (!samples.density) return glFailed();
    const float* rgba = shader.shade(band, behind, samples);
    blender.unmap(behind % 2);
    blender.blend(rgba);
    if (cancel.cancelled()) return Error{"cancelled"};
  }
  return {};
}

Status drawBlend(const Plan& plan, RenderCaches& caches, const CancelToken& cancel, GlState& gl,
                 Rendered& done) {
  RenderStats& stats = done.stats;
  const RenderInputs inputs(plan, caches, stats);
  if (Status s = loadTextures(plan, caches, gl, cancel, stats); !s) return s;
  const double loaded = wallMs();
  const RayGenerator setup(plan, caches.volume()->geometry());
  if (Status s = gl.blender.prepare(plan, gl.textures); !s) return s;
  preparePicture(plan, done.picture);
  SliceShader shader(plan, inputs);
  RayBands bands(setup, plan.options.size, 1);
  RayBand band;
  for (bands.fill(band, plan.options.threads); !band.empty(); bands.fill(band, plan.options.threads)) {
    if (Status s = gl.blender.begin(band, inputs.trace().inverseUnitMm); !s) return s;
    if (Status s = drawSlices(band, gl.blender, shader, cancel); !s) return s;
    if (Status s = writeBand(plan, inputs, band, gl.blender.pixels(), done.picture); !s) return s;
    for (const RayRow& rays : band.rows)
      for (int steps : rays.steps) stats.resampled += steps;
  }
  shader.report(stats);
  stats.glMs = gl.blender.takeGlMs();
  stats.resampleMs = wallMs() - loaded - stats.shadeMs;
  return {};
}

}  // namespace

Result<Rendered> renderBlendGl(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  return onGl(caches, [&](GlState& gl, Rendered& done) { return drawBlend(plan, caches, cancel, gl, done); });
}

}  // namespace volumen
