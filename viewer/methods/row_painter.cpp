#include "viewer/methods/row_painter.h"

#include <algorithm>
#include <cmath>

#include "viewer/volume/clock.h"
#include "viewer/volume/parallel.h"

namespace volumen {

RowPainter::RowPainter(const Plan& plan, const RenderInputs& inputs, Picture& picture,
                       std::vector<float>& error)
    : plan_(plan), inputs_(inputs), picture_(picture), error_(error) {
  if (plan.scene.mode == Mode::composite)
    trace_ = chooseTraceKernel(inputs.key());
  else
    project_ = chooseProjectKernel(inputs.key().store, plan.scene.mode, plan.cellByCell);
  preparePicture(plan, picture);
  if (tellsError(plan)) error.assign(picture.rgba.size() / 4, 0.0f);
}

void RowPainter::paint(const RayRow& rays, const PlaneBuffer& plane, Task& task) const {
  task.values.assign(4 * rays.steps.size(), 0.0f);
  TraceRow out = traceRowOf(task.values);
  if (!error_.empty()) {
    task.error.assign(rays.steps.size(), 0.0f);
    out.error = task.error.data();
  }
  if (project_) {
    project_(inputs_.trace(), inputs_.blocks(), rays, plane, out.red, task.counts);
    writeProjectedPixels(plan_.scene, inputs_.scale(), rays, out.red, picture_);
    roundPixels(plan_.blending, rays, picture_);
    if (!error_.empty()) writeRounding(rays);
    return;
  }
  if (meetsSurfaces(rays, task))
    task.surfaces.trace(inputs_, trace_, out, task.counts);
  else
    trace_(inputs_.trace(), rays, plane, out, task.counts);
  writePixels(plan_.scene.background, rays, out, picture_);
  if (!error_.empty()) writeError(rays, out);
}

bool RowPainter::meetsSurfaces(const RayRow& rays, Task& task) const {
  if (!inputs_.segments()) return false;
  const double begin = wallMs();
  const bool meets = task.surfaces.find(*inputs_.segments(), rays);
  task.counts.surfacesNs += std::int64_t(1e6 * (wallMs() - begin));
  return meets;
}

// Adds to the error of the rules: the light left where a ray ended, and positions rounded to floats.
void RowPainter::writeError(const RayRow& rays, const TraceRow& row) const {
  constexpr float roundingOf255 = 0.05f;
  const float stop = inputs_.trace().stopTransmittance;
  for (std::size_t ray = 0; ray < rays.pixel.size(); ++ray) {
    if (rays.pixel[ray] < 0) continue;
    const float left = 1 - row.alpha[ray], unseen = left < stop ? left * inputs_.brightest() : 0.0f;
    // Steps may miss what a ray passes; from cell to cell it misses nothing.
    const bool isRounded = plan_.cellByCell ? row.alpha[ray] > 0 : rays.steps[ray] > 0;
    error_[std::size_t(rays.pixel[ray])] =
        std::min(255.0f, 255 * (row.error[ray] + unseen) + (isRounded ? roundingOf255 : 0.0f));
  }
}

// Writes the error of extremes and means, which are exact except for the rounding of floats.
void RowPainter::writeRounding(const RayRow& rays) const {
  constexpr double roundings = 16.0 / (1 << 24);
  const DensityScale& scale = inputs_.scale();
  const double most = scale.slope * std::max(std::abs(scale.low), std::abs(scale.high));
  const double off = 255 * (roundings * most / std::abs(plan_.scene.window->width) + 1e-6);
  for (const int pixel : rays.pixel)
    if (pixel >= 0) error_[std::size_t(pixel)] = float(std::min(255.0, off));
}

void TraceTotals::report(const Plan& plan, double passMs, RenderStats& stats) const {
  const double shadeShare = allTicks ? double(shadeTicks) / double(allTicks) : 0;
  const int threads = plan.options.threads > 0 ? plan.options.threads : allowedThreads();
  stats.surfacesMs = std::min(passMs, 1e-6 * double(surfacesNs) / threads);
  const double raysMs = passMs - stats.surfacesMs;
  stats.resampleMs = raysMs * (1 - shadeShare);
  stats.shadeMs = raysMs * shadeShare;
  stats.resampled = resampled;
  stats.composited = composited;
  stats.shaded = plan.lit ? stats.composited : 0;
  stats.kernel = kernelTarget();
}

}  // namespace volumen
