#include "viewer/methods/planes.h"

#include <atomic>

#include "viewer/kernels/ray_generator.h"
#include "viewer/methods/planes_gl.h"
#include "viewer/methods/row_painter.h"
#include "viewer/volume/clock.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

Result<Rendered> renderPlanesCpu(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  Rendered done;
  RenderStats& stats = done.stats;
  const RenderInputs inputs(plan, caches, stats);
  const RayGenerator setup(plan, caches.volume()->geometry());
  const RowPainter painter(plan, inputs, done.picture, done.error);

  TraceTotals totals;
  const double begin = wallMs();
  std::atomic<std::int64_t> finished{0};
  const glm::ivec2 blocks = (plan.options.size + (RayGenerator::block - 1)) / RayGenerator::block;
  const std::int64_t count = std::int64_t(blocks.x) * blocks.y;
  parallelFor(count, plan.options.threads, [&](std::int64_t first, std::int64_t last) {
    RayRow rays;
    RowPainter::Task task;
    for (std::int64_t n = first; n < last && !cancel.cancelled(); ++n) {
      setup.makeBlock(int(n % blocks.x) * RayGenerator::block, int(n / blocks.x) * RayGenerator::block, rays);
      painter.paint(rays, {}, task);
      cancel.setDone(double(++finished) / double(count));
    }
    totals.add(task.counts);
  });
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
