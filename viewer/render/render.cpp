#include "viewer/render/render.h"

#include <chrono>

#include "viewer/render/methods/planes.h"
#include "viewer/render/reference.h"
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

}  // namespace

Result<Rendered> render(const Plan& plan, RenderCaches& caches, const CancelToken& cancel) {
  const auto begin = std::chrono::steady_clock::now();
  auto done = plan.method == Method::reference ? renderTruth(plan, caches, cancel)
                                               : renderPlanes(plan, caches, cancel);
  if (!done) return done;
  done->stats.totalMs =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  done->stats.threads = plan.options.threads > 0 ? plan.options.threads : allowedThreads();
  return done;
}

}  // namespace volumen
