#include "ui/features/feature.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// Tells features about pictures of the panels' 3D view, and reports failed drawings.
class Drawing : public Feature {
 public:
  explicit Drawing(Workbench& bench);

 private:
  void tellDrawn(const ScreenPicture& drawn);
};

Drawing::Drawing(Workbench& bench) : Feature(bench) {
  connect(&bench_.document.drawService, &DrawService::failed, this,
          [this](ViewId, const QString& sentence) { warnUntilDone(sentence); });
  connect(&bench_.document.slices, &SliceService::failed, this,
          [this](int, const QString& sentence) { warnUntilDone(sentence); });
  bench_.forEachVolumeView(
      [this](VolumeView* view) { connect(view, &VolumeView::drawn, this, &Drawing::tellDrawn); });
  whenChanged(
      session_, this, [this] { bench_.document.drawService.setGestureView(session_.workspace().focus); },
      &Workspace::focus);
  // Requests a picture because the panels need its data.
  whenChanged(
      session_, this, [this] { bench_.view()->requestPicture(); }, sceneViewOf);
}

void Drawing::tellDrawn(const ScreenPicture& drawn) {
  if (drawn.view != sceneViewOf(session_.workspace())) return;
  Q_EMIT bench_.drawn(drawn);
  if (drawn.draft()) return;
  Scene now = bench_.document.drawn.scene(drawn.view);
  if (!now.camera) now.camera = drawn.scene.camera;
  if (now != drawn.scene) return;
  // The plan's camera sees slightly more if one ray covers several pixels.
  Scene complete = drawn.plan->scene;
  const auto target = complete.camera->target;
  complete.camera = drawn.scene.camera;
  if (!complete.camera->target) complete.camera->target = target;
  Q_EMIT bench_.drawnAtRest(drawn, complete);
}

}  // namespace

std::unique_ptr<Feature> makeDrawing(Workbench& bench) { return std::make_unique<Drawing>(bench); }

}  // namespace volumen
