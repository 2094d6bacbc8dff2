#include "viewer/render/render.h"

#include <new>

#include "viewer/methods/blend_gl.h"
#include "viewer/methods/cast_gl.h"
#include "viewer/methods/planes.h"
#include "viewer/methods/preshaded.h"
#include "viewer/reference/reference.h"
#include "viewer/render/memory_need.h"
#include "viewer/render/pilot.h"
#include "viewer/volume/available_memory.h"
#include "viewer/volume/clock.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

Result<Rendered> renderTruth(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  auto picture =
      renderReference(plan.scene, *caches.volume(), plan.options.size, plan.options.threads, cancel);
  if (!picture) return picture.error();
  Rendered done;
  done.picture = std::move(*picture);
  done.stats.kernel = "reference";
  return done;
}

Status checkSize(const Plan& plan, const Volume& volume) {
  // The kernels count samples in 32 bits.
  const std::int64_t most = std::int64_t(1) << (plan.bits == 32 ? 29 : 30);
  if (volume.geometry().voxelCount() < most) return {};
  return Error{"The volume has " + std::to_string(volume.geometry().voxelCount()) +
               " voxels, more than the fast methods can draw; use --method reference."};
}

Result<Rendered> renderBy(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  if (plan.method == Method::reference) return renderTruth(plan, caches, cancel);
  if (Status s = checkSize(plan, *caches.volume()); !s) return s.error();
  const bool gl = plan.resampler == Resampler::gl;
  switch (plan.method) {
    case Method::blend:
      return gl ? renderBlendGl(plan, caches, cancel) : renderPlanes(plan, caches, cancel);
    case Method::preshaded:
      return gl ? renderCastGl(plan, caches, cancel) : renderPreshaded(plan, caches, cancel);
    case Method::gpu:
      return renderCastGl(plan, caches, cancel);
    case Method::reference:
    case Method::planes:
      break;
  }
  return renderPlanes(plan, caches, cancel);
}

Error notEnoughMemory(const Plan& plan, const Volume& volume) {
  const std::string what = "There is not enough memory: to draw " +
                           std::to_string(volume.geometry().voxelCount()) + " voxels this way at " +
                           std::to_string(plan.bits) + " bits";
  return {tooLittleMemory(what, bytesToDraw(plan, volume.geometry(), volume.stored())).message +
          " Or use --method planes, fewer bits (--precision) or an unlit scene."};
}

}  // namespace

Result<Plan> completedPlan(const Plan& plan, RenderCaches& caches, RenderStats& stats,
                           const CancelToken& cancel) {
  if (!plan.pilotSteps) return plan;
  if (Status s = checkSize(plan, *caches.volume()); !s) return s.error();
  const double begin = wallMs(), gradientsBefore = stats.gradientsMs;
  Result<PilotFinding> found = Error{};
  try {
    found = probe(plan, caches, stats, cancel);
  } catch (const std::bad_alloc&) {
    return notEnoughMemory(plan, *caches.volume());
  }
  stats.pilotMs += wallMs() - begin - (stats.gradientsMs - gradientsBefore);
  if (!found) return found.error();
  return makePlan(plan.scene, caches.facts(), plan.options, *found);
}

Result<Rendered> render(const Plan& asked, RenderCaches& caches, const CancelToken& cancel) {
  const double begin = wallMs();
  RenderStats pilot;
  auto plan = completedPlan(asked, caches, pilot, cancel);
  if (!plan) return plan.error();
  Result<Rendered> done = Error{};
  try {
    done = renderBy(*plan, caches, cancel);
  } catch (const std::bad_alloc&) {
    return notEnoughMemory(*plan, *caches.volume());
  }
  if (!done) return done;
  done->stats.gradientsMs += pilot.gradientsMs;
  done->stats.pilotMs = pilot.pilotMs;
  done->stats.totalMs = wallMs() - begin;
  done->stats.threads = plan->options.threads > 0 ? plan->options.threads : allowedThreads();
  done->plan = std::move(*plan);
  return done;
}

}  // namespace volumen
