#include "ui/controller/screen_picture.h"

#include <algorithm>

#include "viewer/plan/picture_text.h"
#include "viewer/scene/first_camera.h"

namespace volumen {

namespace {

using Clock = std::chrono::steady_clock;

// The scene and options of a pass.
struct PassView {
  Scene shown;  // with its camera
  Scene scene;  // at the resolution of the pass
  RenderOptions options;
};

PassView viewOf(const ScreenRequest& request, Pass pass, const VoxelGeometry& geometry) {
  PassView view{request.scene, {}, {}};
  if (!view.shown.camera)
    view.shown.camera =
        fitCamera(firstCamera(geometry), geometry, double(request.pixels.width()) / request.pixels.height());
  const DraftView draft = draftView(*view.shown.camera, request.pixels, pass.factor);
  view.scene = view.shown;
  view.scene.camera = draft.camera;
  view.options.size = {draft.size.width(), draft.size.height()};
  view.options.quality = pass.quality;
  view.options.withError = request.withError && pass.factor == 1;
  if (request.resampler != Resampler::gl) return view;
  if (pass.quality != Quality::draft)
    view.options.resampler = Resampler::gl;
  else if (request.level.quality != Quality::draft)
    view.scene.segments.clear();  // OpenGL will leave them out at rest
  return view;
}

}  // namespace

PlannedPass planPass(const Draw& draw, const Volume& volume, const ScreenRequest& request, Pass pass,
                     Clock::time_point from, const CancelToken& cancel) {
  from = std::max(from, Clock::now());
  const PassView view = viewOf(request, pass, volume.geometry());
  return {draw.plan(view.scene, view.options, cancel), from};
}

Result<DrawnPass> drawPass(const Draw& draw, const Volume& volume, const ScreenRequest& request, Pass pass,
                           const CancelToken& cancel, const PlannedPass* ahead) {
  std::optional<PlannedPass> now;
  if (!ahead) ahead = &now.emplace(planPass(draw, volume, request, pass, Clock::now(), cancel));
  if (!ahead->planned) return ahead->planned.error();
  Result<Drawn> drawn = draw.picture(*ahead->planned, cancel);
  if (!drawn) return drawn.error();
  PassView view = viewOf(request, pass, volume.geometry());
  ScreenPicture shown;
  shown.number = request.number;
  shown.quality = pass.quality;
  shown.factor = pass.factor;
  shown.scene = std::move(view.shown);
  shown.image =
      pass.factor == 1 ? toImage(drawn->picture) : enlarged(drawn->picture, pass.factor, request.pixels);
  shown.plan = std::make_shared<const Plan>(drawn->plan);
  shown.stats = drawn->stats;
  shown.warnings = drawn->warnings;
  shown.estimated = pass.factor == 1 ? estimateOf(drawn->plan, drawn->error) : std::nullopt;
  if (shown.estimated) shown.error = std::make_shared<const std::vector<float>>(drawn->error);
  shown.ms = std::chrono::duration<double, std::milli>(Clock::now() - ahead->from).count();
  return DrawnPass{std::move(*drawn), std::move(shown)};
}

}  // namespace volumen
