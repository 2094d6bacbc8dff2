#include "viewer/render/methods/planes.h"

#include <chrono>

#include "viewer/render/methods/planes_gl.h"
#include "viewer/render/methods/row_painter.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

Status checkSize(const Plan& plan, const Volume& volume) {
  // The kernels count samples in 32 bits.
  const std::int64_t most = std::int64_t(1) << (plan.bits == 16 ? 30 : 29);
  if (volume.geometry().voxelCount() < most) return {};
  return Error{"The volume has " + std::to_string(volume.geometry().voxelCount()) +
               " voxels, more than the fast method can draw; use --method reference."};
}

Result<Rendered> renderPlanesCpu(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  Rendered done;
  RenderStats& stats = done.stats;
  const PlanesFrame frame(plan, caches, stats);
  const RaySetup setup(plan.scene, caches.volume()->geometry(), plan.options.size, plan.stepVoxels,
                       plan.clip);
  const RowPainter painter(plan, frame, done.picture);

  TraceTotals totals;
  const auto begin = std::chrono::steady_clock::now();
  const int bands = (plan.options.size.y + RaySetup::tile - 1) / RaySetup::tile;
  parallelFor(bands, plan.options.threads, [&](std::int64_t first, std::int64_t last) {
    RayRow rays;
    RowPainter::Task task;
    for (int band = int(first); band < last && !cancel.cancelled(); ++band) {
      setup.makeTiles(band * RaySetup::tile, rays);
      painter.paint(rays, {}, task);
    }
    totals.add(task.counts);
  });
  if (cancel.cancelled()) return Error{"cancelled"};

  const double passMs =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  const double shadeShare = totals.allTicks ? double(totals.shadeTicks) / double(totals.allTicks) : 0;
  stats.resampleMs = passMs * (1 - shadeShare);
  stats.shadeMs = passMs * shadeShare;
  stats.resampled = totals.resampled;
  stats.composited = totals.composited;
  stats.shaded = plan.lit ? stats.composited : 0;
  stats.kernel = kernelTarget();
  return done;
}

}  // namespace

Result<Rendered> renderPlanes(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  if (Status s = checkSize(plan, *caches.volume()); !s) return s.error();
  return plan.resampler == Resampler::gl ? renderPlanesGl(plan, caches, cancel)
                                         : renderPlanesCpu(plan, caches, cancel);
}

}  // namespace volumen
