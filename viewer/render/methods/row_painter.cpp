#include "viewer/render/methods/row_painter.h"

namespace volumen {

RowPainter::RowPainter(const Plan& plan, const PlanesFrame& frame, Picture& picture)
    : plan_(plan), frame_(frame), picture_(picture) {
  if (plan.scene.mode == Mode::composite)
    trace_ = chooseTraceKernel(frame.key());
  else
    project_ = chooseProjectKernel(frame.key().store, plan.scene.mode, plan.cellByCell);
  preparePicture(plan, picture);
}

void RowPainter::paint(const RayRow& rays, const PlaneBuffer& plane, Task& task) const {
  task.values.assign(4 * rays.steps.size(), 0.0f);
  const TraceRow out = traceRowOf(task.values);
  if (project_) {
    project_(frame_.trace(), frame_.blocks(), rays, plane, out.red, task.counts);
    writeProjectedPixels(plan_.scene, frame_.scale(), rays, out.red, picture_);
    roundPixels(plan_.blending, rays, picture_);
    return;
  }
  trace_(frame_.trace(), rays, plane, out, task.counts);
  writePixels(plan_.scene.background, rays, out, picture_);
}

void TraceTotals::report(const Plan& plan, double passMs, RenderStats& stats) const {
  const double shadeShare = allTicks ? double(shadeTicks) / double(allTicks) : 0;
  stats.resampleMs = passMs * (1 - shadeShare);
  stats.shadeMs = passMs * shadeShare;
  stats.resampled = resampled;
  stats.composited = composited;
  stats.shaded = plan.lit ? stats.composited : 0;
  stats.kernel = kernelTarget();
}

}  // namespace volumen
