#include "viewer/render/methods/planes.h"

#include <atomic>
#include <chrono>

#include "viewer/render/caches.h"
#include "viewer/render/methods/planes_frame.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Memory for one row of rays and what they come to; one a task.
struct RowMemory {
  RayRow rays;
  std::vector<float> values;  ///< red, green, blue, alpha
  TraceRow out;

  void prepare(const RaySetup& setup, int y) {
    setup.makeRow(y, rays);
    const std::size_t n = rays.steps.size();
    values.assign(4 * n, 0.0f);
    out = {values.data(), values.data() + n, values.data() + 2 * n, values.data() + 3 * n};
  }
};

// Sums of all rows; integers, so that their order does not matter.
struct Totals {
  std::atomic<std::int64_t> resampled{0}, composited{0}, shadeTicks{0}, allTicks{0};
  void add(const TraceCounts& c) {
    resampled += c.resampled;
    composited += c.composited;
    shadeTicks += c.shadeTicks;
    allTicks += c.allTicks;
  }
};

Status checkSize(const Plan& plan, const Volume& volume) {
  // The kernels count samples in 32 bits.
  const std::int64_t most = std::int64_t(1) << (plan.bits == 16 ? 30 : 29);
  if (volume.geometry().voxelCount() < most) return {};
  return Error{"The volume has " + std::to_string(volume.geometry().voxelCount()) +
               " voxels, more than the fast method can draw; use --method reference."};
}

}  // namespace

Result<Rendered> renderPlanes(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  if (Status s = checkSize(plan, *caches.volume()); !s) return s.error();
  Rendered done;
  RenderStats& stats = done.stats;
  const PlanesFrame frame(plan, caches, true, stats);
  const RaySetup setup(plan.scene, caches.volume()->geometry(), plan.options.size, plan.stepVoxels,
                       plan.clip);
  const bool composite = plan.scene.mode == Mode::composite;
  const TraceKernel trace = chooseTraceKernel(frame.key());
  const ProjectKernel project = composite ? nullptr : chooseProjectKernel(frame.key().store, plan.scene.mode);
  Picture& picture = done.picture;
  picture.size = plan.options.size;
  picture.transparent = plan.scene.background.transparent;
  picture.rgba.resize(std::size_t(4) * picture.size.x * picture.size.y);

  Totals totals;
  const auto begin = std::chrono::steady_clock::now();
  parallelFor(picture.size.y, plan.options.threads, [&](std::int64_t first, std::int64_t last) {
    RowMemory memory;
    TraceCounts counts;
    for (int y = int(first); y < last && !cancel.cancelled(); ++y) {
      memory.prepare(setup, y);
      if (composite) {
        trace(frame.trace(), memory.rays, {}, memory.out, counts);
        writeRow(plan.scene.background, memory.out, picture.size.x, picture.row(y));
      } else {
        project(frame.trace(), memory.rays, {}, memory.values.data());
        writeProjectedRow(plan.scene, frame.scale(), memory.rays, memory.values.data(), picture.row(y));
        for (int steps : memory.rays.steps) counts.resampled += steps;
      }
    }
    totals.add(counts);
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

}  // namespace volumen
