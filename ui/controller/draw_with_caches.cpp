#include "ui/controller/qt_gl_context.h"
#include "ui/controller/render_controller.h"

namespace volumen {

Draw drawWithCaches(VolumePtr volume) {
  auto caches = std::make_shared<RenderCaches>(std::move(volume));
  caches->setGlContextFactory([] {
    auto context = makeQtGlContext();
    return context ? std::move(context) : makeEglContext();
  });
  caches->facts();  // here, so that it does not count as time of the first frame
  return
      [caches](const Scene& scene, const RenderOptions& options, const CancelToken& cancel) -> Result<Drawn> {
        const Result<Plan> plan = makePlan(scene, caches->facts(), options);
        if (!plan) return plan.error();
        Result<Rendered> rendered = render(*plan, *caches, cancel);
        if (!rendered) return rendered.error();
        return Drawn{std::move(rendered->picture), std::move(rendered->plan), rendered->stats};
      };
}

}  // namespace volumen
