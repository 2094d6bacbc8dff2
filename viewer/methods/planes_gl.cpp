#include "viewer/methods/planes_gl.h"

#include <numeric>

#include "viewer/methods/gl_band.h"
#include "viewer/methods/row_painter.h"
#include "viewer/volume/clock.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Shades a batch that has been read back, on all cores.
class BatchShader {
 public:
  BatchShader(const RowPainter& painter, int threads) : painter_(painter), threads_(threads) {}

  void shade(const Batch& batch, const SampleTarget::Samples& samples) {
    const double begin = wallMs();
    parallelFor(std::int64_t(batch.strips.size()), threads_, [&](std::int64_t first, std::int64_t last) {
      RowPainter::Task task;
      for (std::int64_t n = first; n < last; ++n) {
        const Strip& s = batch.strips[n];
        const std::size_t at = std::size_t(s.firstLine) * Batch::line;
        painter_.paint(
            s.rays,
            {samples.density + at, samples.gradients ? samples.gradients + 4 * at : nullptr, s.stride()},
            task);
      }
      totals_.add(task.counts);
    });
    for (const Strip& s : batch.strips)
      resampled_ += std::accumulate(s.rays.steps.begin(), s.rays.steps.end(), std::int64_t(0));
    ms_ += wallMs() - begin;
  }

  void report(const Plan& plan, RenderStats& stats) const {
    stats.shadeMs = ms_;
    stats.resampled = resampled_;
    stats.composited = totals_.composited;
    stats.shaded = plan.lit ? stats.composited : 0;
  }

 private:
  const RowPainter& painter_;
  int threads_;
  TraceTotals totals_;
  std::int64_t resampled_ = 0;
  double ms_ = 0;
};

// Round n starts to read back batch n - 1, starts to draw batch n, and shades batch n - 2.
Status drawBatches(BatchMaker& maker, PlaneResampler& resampler, BatchShader& shader,
                   const CancelToken& cancel) {
  Batch ring[3];
  for (int n = 0;; ++n) {
    Batch &next = ring[n % 3], &drawn = ring[(n + 2) % 3], &back = ring[(n + 1) % 3];
    const int slot = n % 2, other = 1 - slot;
    if (!drawn.empty()) resampler.startReading(drawn, other);
    maker.fill(next);
    if (!next.empty())
      if (Status s = resampler.draw(next, slot); !s) return s;
    if (!back.empty()) {
      const SampleTarget::Samples samples = resampler.map(slot);
      if (!samples.density) return glFailed();
      shader.shade(back, samples);
      resampler.unmap(slot);
    }
    if (next.empty() && drawn.empty()) return {};
    if (cancel.cancelled()) return Error{"cancelled"};
  }
}

Status drawPlanes(const Plan& plan, RenderCaches& caches, const CancelToken& cancel, GlState& gl,
                  Rendered& done) {
  RenderStats& stats = done.stats;
  const RenderInputs inputs(plan, caches, stats);
  if (Status s = loadTextures(plan, caches, gl, cancel, stats); !s) return s;
  const double loaded = wallMs();
  const RayGenerator setup(plan, caches.volume()->geometry());
  BatchMaker maker(setup, plan.options.size, mostSteps(caches.volume()->size(), plan.stepVoxels));
  if (Status s = gl.resampler.prepare(plan, gl.textures, maker.lines()); !s) return s;
  const RowPainter painter(plan, inputs, done.picture, done.error);
  BatchShader shader(painter, plan.options.threads);
  if (Status s = drawBatches(maker, gl.resampler, shader, cancel); !s) return s;
  shader.report(plan, stats);
  stats.glMs = gl.resampler.takeGlMs();
  stats.resampleMs = wallMs() - loaded - stats.shadeMs;
  return {};
}

}  // namespace

Result<Rendered> renderPlanesGl(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  return onGl(caches,
              [&](GlState& gl, Rendered& done) { return drawPlanes(plan, caches, cancel, gl, done); });
}

}  // namespace volumen
