#include "viewer/render/methods/blend.h"

#include "viewer/render/caches.h"
#include "viewer/render/methods/frame_row.h"
#include "viewer/render/methods/row_painter.h"
#include "viewer/render/methods/slice_row.h"
#include "viewer/render/methods/ticks.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Memory of one thread, and what it counted.
struct BlendTask {
  RayRow rays;
  std::vector<float> density, gradients, units, slice;
  TraceCounts counts;
};

class BlendPainter {
 public:
  BlendPainter(const Plan& plan, const PlanesFrame& frame, const RaySetup& setup, Picture& picture)
      : plan_(plan),
        frame_(frame),
        setup_(setup),
        picture_(picture),
        resample_(chooseResampleKernel(frame.key().store)),
        shade_(chooseShadeKernel(frame.key())) {
    preparePicture(plan, picture);
  }

  void paintRow(int y, BlendTask& task) const {
    const std::int64_t begin = ticks();
    setup_.makeRays(0, y, picture_.size.x, task.rays);
    const std::size_t count = task.rays.steps.size();
    task.density.assign(count, 0);
    task.gradients.assign(plan_.gradients ? 4 * count : 0, 0);
    task.slice.resize(4 * count);
    if (plan_.scene.mode == Mode::composite)
      compositeRow(task);
    else
      projectRow(task);
    task.counts.allTicks += ticks() - begin;
  }

 private:
  void resampleSlice(int n, BlendTask& task) const {
    resample_(frame_.trace(), task.rays, n, task.density.data(),
              plan_.gradients ? task.gradients.data() : nullptr);
    unitsOfSlice(task.rays, n, frame_.trace().inverseUnitMm, task.units);
  }

  void compositeRow(BlendTask& task) const {
    const RayRow& rays = task.rays;
    FrameRow pixels(plan_.blending, rays.steps.size());
    const TraceRow slice = FrameRow::rowOf(task.slice);
    for (int n = longestOf(rays) - 1; n >= 0; --n) {
      resampleSlice(n, task);
      const std::int64_t begin = ticks();
      const SampleRow samples{int(rays.steps.size()), task.density.data(), task.gradients.data(),
                              task.units.data(),      rays.viewerX.data(), rays.viewerY.data(),
                              rays.viewerZ.data()};
      const std::int64_t visible = shade_(frame_.trace(), samples, slice);
      if (visible > 0) pixels.blend(slice);
      task.counts.composited += visible;
      task.counts.shadeTicks += ticks() - begin;
    }
    countSamples(task);
    writePixels(plan_.scene.background, rays, pixels.pixels(), picture_);
  }

  void projectRow(BlendTask& task) const {
    ProjectedRow values(plan_.scene.mode, task.rays.steps.size());
    for (int n = longestOf(task.rays) - 1; n >= 0; --n) {
      resampleSlice(n, task);
      values.add(task.density.data(), task.units.data());
    }
    countSamples(task);
    writeProjectedPixels(plan_.scene, frame_.scale(), task.rays, values.result(), picture_);
    roundPixels(plan_.blending, task.rays, picture_);
  }

  static void countSamples(BlendTask& task) {
    for (int steps : task.rays.steps) task.counts.resampled += steps;
  }

  const Plan& plan_;
  const PlanesFrame& frame_;
  const RaySetup& setup_;
  Picture& picture_;
  ResampleKernel resample_;
  ShadeKernel shade_;
};

}  // namespace

Result<Rendered> renderBlend(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  Rendered done;
  RenderStats& stats = done.stats;
  const PlanesFrame frame(plan, caches, stats);
  const RaySetup setup(plan, caches.volume()->geometry());
  const BlendPainter painter(plan, frame, setup, done.picture);
  TraceTotals totals;
  const double begin = nowMs();
  parallelFor(plan.options.size.y, plan.options.threads, [&](std::int64_t first, std::int64_t last) {
    BlendTask task;
    for (int y = int(first); y < last && !cancel.cancelled(); ++y) painter.paintRow(y, task);
    totals.add(task.counts);
  });
  if (cancel.cancelled()) return Error{"cancelled"};
  totals.report(plan, nowMs() - begin, stats);
  return done;
}

}  // namespace volumen
