#include "ui/controller/draw.h"

#include <new>

#include "ui/controller/qt_gl_context.h"

namespace volumen {

namespace {

Result<Planned> planned(RenderCaches& caches, const Scene& scene, const RenderOptions& options,
                        const CancelToken& cancel) try {
  const Result<Plan> asked = makePlan(scene, caches.facts(), options);
  if (!asked) return asked.error();
  RenderStats stats;
  Result<Plan> done = completedPlan(*asked, caches, stats, cancel);
  if (!done) return done.error();
  return Planned{std::move(*done), stats};
} catch (const std::bad_alloc&) {
  return Error{"There is not enough memory to draw this volume; close other programs or series."};
}

}  // namespace

Result<Drawn> Draw::operator()(const Scene& scene, const RenderOptions& options,
                               const CancelToken& cancel) const {
  const Result<Planned> planned = plan(scene, options, cancel);
  if (!planned) return planned.error();
  return picture(*planned, cancel);
}

Draw drawWithCaches(const VoxelsPtr& voxels) {
  auto caches = std::make_shared<RenderCaches>(voxels);
  caches->setGlContextFactory([] {
    auto context = makeQtGlContext();
    return context ? std::move(context) : makeEglContext();
  });
  try {
    caches->facts();  // here, so that it does not count as time of the first frame
  } catch (const std::bad_alloc&) {
    // The first plan tells of it.
  }
  const auto plan = [caches](const auto&... asked) { return planned(*caches, asked...); };
  const auto picture = [caches](const Planned& planned, const CancelToken& cancel) -> Result<Drawn> {
    Result<Rendered> rendered = render(planned.plan, *caches, cancel);
    if (!rendered) return rendered.error();
    RenderStats stats = rendered->stats;
    stats.pilotMs += planned.stats.pilotMs;
    stats.gradientsMs += planned.stats.gradientsMs;
    stats.totalMs += planned.stats.pilotMs + planned.stats.gradientsMs;
    return Drawn{std::move(rendered->picture), std::move(rendered->error), std::move(rendered->plan), stats};
  };
  return {plan, picture, [caches] { return caches->bytes(); }};
}

}  // namespace volumen
