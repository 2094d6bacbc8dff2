#include "viewer/evaluation/orbit.h"

#include "viewer/evaluation/statistics.h"
#include "viewer/volume/clock.h"

namespace volumen {

namespace {

Status drawView(const Plan& plan, RenderCaches& caches, const CancelToken& cancel, OrbitView& view) {
  const double begin = wallMs(), processor = processorMs();
  auto done = render(plan, caches, cancel);
  if (!done) return done.error();
  view.framesMs.push_back(wallMs() - begin);
  view.processorsMs.push_back(processorMs() - processor);
  view.stats = std::move(done->stats);
  return {};
}

// Makes the first plan and draws its picture, which fills gradients, blocks and copies.
Status drawFirst(const Scene& scene, const RenderOptions& options, RenderCaches& caches,
                 const CancelToken& cancel, Orbit& out) {
  const double begin = wallMs();
  auto plan = makePlan(scene, caches.facts(), options);
  if (!plan) return plan.error();
  out.plan = std::move(*plan);
  auto done = render(out.plan, caches, cancel);
  if (!done) return done.error();
  out.firstFrameMs = wallMs() - begin;
  out.plan = done->plan;
  out.gradientsMs = done->stats.gradientsMs;
  return {};
}

Result<std::vector<Plan>> plansAround(const Plan& first, int views, RenderCaches& caches) {
  std::vector<Plan> plans;
  for (int n = 0; n < views; ++n) {
    Scene scene = first.scene;
    *scene.camera = turned(*scene.camera, 360.0 * n / views);
    auto plan = makePlan(scene, caches.facts(), first.options);
    if (!plan) return plan.error();
    plans.push_back(std::move(*plan));
  }
  return plans;
}

}  // namespace

Result<Orbit> measureOrbit(const Scene& scene, const RenderOptions& options, const OrbitOptions& orbit,
                           RenderCaches& caches, const StudyProgress& progress, const CancelToken& cancel) {
  Orbit out;
  if (Status s = drawFirst(scene, options, caches, cancel, out); !s) return s.error();
  const auto plans = plansAround(out.plan, orbit.views, caches);
  if (!plans) return plans.error();
  for (int n = 0; n < orbit.views; ++n) out.views.push_back({360.0 * n / orbit.views, {}, {}, {}});
  const std::size_t all = std::size_t(orbit.views) * orbit.rounds;
  for (std::size_t frame = 0; frame < all; ++frame) {
    if (progress) progress("drawing", frame, all);
    const std::size_t n = frame % plans->size();
    if (Status s = drawView((*plans)[n], caches, cancel, out.views[n]); !s) return s.error();
  }
  return out;
}

namespace {
std::vector<double> joined(const Orbit& orbit, std::vector<double> OrbitView::*times) {
  std::vector<double> all;
  for (const OrbitView& v : orbit.views) all.insert(all.end(), (v.*times).begin(), (v.*times).end());
  return all;
}
}  // namespace

std::vector<double> allFramesMs(const Orbit& orbit) { return joined(orbit, &OrbitView::framesMs); }
std::vector<double> allProcessorsMs(const Orbit& orbit) { return joined(orbit, &OrbitView::processorsMs); }

}  // namespace volumen
