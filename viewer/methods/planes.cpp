#include "viewer/methods/planes.h"

#include <algorithm>
#include <atomic>

#include "viewer/kernels/ray_generator.h"
#include "viewer/methods/planes_gl.h"
#include "viewer/methods/row_painter.h"
#include "viewer/volume/clock.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Calls make(n, rays) for n from 0 up to `count`, and paints the rays. Adds to `totals`.
template <class Make>
void paintAll(std::int64_t count, const Plan& plan, const RowPainter& painter, const CancelToken& cancel,
              TraceTotals& totals, const Make& make) {
  parallelFor(count, plan.options.threads, [&](std::int64_t first, std::int64_t last) {
    RayRow rays;
    RowPainter::Task task;
    for (std::int64_t n = first; n < last && !cancel.cancelled(); ++n) {
      make(n, rays);
      painter.paint(rays, {}, task);
    }
    totals.add(task.counts);
  });
}

// Returns the pixels whose error exceeds `limit255`, in whole tiles. Other pixels of these tiles are -1.
std::vector<int> pixelsAbove(float limit255, glm::ivec2 size, const std::vector<float>& error) {
  constexpr int edge = RayGenerator::tile;
  std::vector<int> pixels;
  for (int ty = 0; ty < size.y; ty += edge)
    for (int tx = 0; tx < size.x; tx += edge) {
      const std::size_t begin = pixels.size();
      bool any = false;
      for (int n = 0; n < edge * edge; ++n) {
        const int x = tx + n % edge, y = ty + n / edge, pixel = y * size.x + x;
        const bool isAbove = x < size.x && y < size.y && error[std::size_t(pixel)] > limit255;
        pixels.push_back(isAbove ? pixel : -1);
        any |= isAbove;
      }
      if (!any) pixels.resize(begin);
    }
  return pixels;
}

// Redoes the rays of `pixels` (-1: none) cell by cell, and sets their error.
void redo(const std::vector<int>& pixels, const Plan& plan, RenderCaches& caches, const CancelToken& cancel,
          TraceTotals& totals, Rendered& done) {
  const Plan finer = *makePlan(plan.scene, caches.facts(), plan.options, PilotFinding{});
  RenderStats stats;
  const RenderInputs inputs(finer, caches, stats);
  const RayGenerator setup(finer, caches.volume()->geometry());
  std::vector<float> error;
  const RowPainter painter(finer, inputs, done.picture, error);
  constexpr std::int64_t atOnce = RayGenerator::block * RayGenerator::block;
  const auto all = std::int64_t(pixels.size());
  paintAll((all + atOnce - 1) / atOnce, plan, painter, cancel, totals, [&](std::int64_t n, RayRow& rays) {
    setup.makePixels({pixels.begin() + n * atOnce, pixels.begin() + std::min(all, (n + 1) * atOnce)}, rays);
  });
  for (const int pixel : pixels)
    if (pixel >= 0) done.error[std::size_t(pixel)] = error[std::size_t(pixel)];
}

// Completes a picture of plain steps that a pilot accepted. So far its error is the change from steps of
// twice the length.
void finish(const Plan& plan, RenderCaches& caches, const CancelToken& cancel, TraceTotals& totals,
            Rendered& done) {
  std::vector<int> pixels;
  if (plan.redoneAbove > 0)
    pixels = pixelsAbove(float(255 * plan.redoneAbove), plan.options.size, done.error);
  done.stats.redone = std::ranges::count_if(pixels, [](int pixel) { return pixel >= 0; });
  for (float& error : done.error)
    if (error > 0)
      error = float(std::min(255.0, plan.pilot->errorScale * (PilotFinding::leastChange + error)));
  if (!pixels.empty()) redo(pixels, plan, caches, cancel, totals, done);
}

Result<Rendered> renderPlanesCpu(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  Rendered done;
  RenderStats& stats = done.stats;
  const RenderInputs inputs(plan, caches, stats);
  const RayGenerator setup(plan, caches.volume()->geometry());
  const RowPainter painter(plan, inputs, done.picture, done.error);

  TraceTotals totals;
  const double begin = wallMs();
  const glm::ivec2 blocks = (plan.options.size + (RayGenerator::block - 1)) / RayGenerator::block;
  const std::int64_t count = std::int64_t(blocks.x) * blocks.y;
  std::atomic<std::int64_t> begun{0};
  paintAll(count, plan, painter, cancel, totals, [&](std::int64_t n, RayRow& rays) {
    setup.makeBlock(int(n % blocks.x) * RayGenerator::block, int(n / blocks.x) * RayGenerator::block, rays);
    cancel.setDone(double(begun++) / double(count));
  });
  if (!plan.cellByCell && tellsError(plan) && !cancel.cancelled()) finish(plan, caches, cancel, totals, done);
  if (cancel.cancelled()) return Error{"cancelled"};

  totals.report(plan, wallMs() - begin, stats);
  return done;
}

}  // namespace

Result<Rendered> renderPlanes(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  return plan.resampler == Resampler::gl ? renderPlanesGl(plan, caches, cancel)
                                         : renderPlanesCpu(plan, caches, cancel);
}

}  // namespace volumen
