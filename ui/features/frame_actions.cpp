#include <QMenu>
#include <algorithm>

#include "io/study/frame_series.h"
#include "results/text/text.h"
#include "results/text/text.h"
#include "ui/features/feature.h"
#include "ui/panels/flat_menus.h"
#include "ui/panels/pet_unit_menu.h"
#include "ui/panels/slab_menu.h"
#include "ui/tools/tool.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/frame_look.h"
#include "ui/workspace/time_points.h"
#include "ui/workspace/view_window.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// Actions of frames (overlays, windows, clips) and the context menu of slices and frames.
class FrameActions : public Feature {
 public:
  explicit FrameActions(Workbench& bench);

 private:
  void makeActions();
  void connectFrames();
  void setShowAsFrames(bool asFrames);
  void showFrameActions();
  void tellWhyFrames();
  void showSliceMenu(FlatView* view, QPoint global);

  QAction *interpolate_, *asFrames_, *ownWindows_, *layers_, *play_, *goToNumber_;
  QMenu *slab_, *colours_, *petUnit_;
};

FrameActions::FrameActions(Workbench& bench)
    : Feature(bench),
      slab_(makeSlabMenu(session_, &bench_.window)),
      colours_(makeColourMenu(session_, &bench_.window)),
      petUnit_(makePetUnitMenu(session_, &bench_.window)) {
  makeActions();
  connectFrames();
  showFrameActions();
}

void FrameActions::makeActions() {
  // These actions follow what is shown, so only a click triggers them.
  const auto add = [this](const char* name, const QString& text) {
    return bench_.addAction({name, text, {}, "", true, {}, {{"viewMenu", 30}}});
  };
  asFrames_ = add("showAsFrames", tr("Show as frames"));
  ownWindows_ = add("ownWindows", tr("Each image its own window"));
  layers_ = add("overlaysAndShutters", tr("Overlays and shutters"));
  connect(asFrames_, &QAction::triggered, this, &FrameActions::setShowAsFrames);
  connect(ownWindows_, &QAction::triggered, this, [this](bool on) {
    session_.endGesture();
    session_.change(tr("Each image its own window"), [&](Workspace& w) {
      const ViewId view = framesViewOf(w.focus);
      w.series.edit(w.view(view).series).frameWindow = on ? FrameWindow::ofEach : FrameWindow::ofSeries;
      setWindow(w, view, ChosenWindow());
    });
  });
  connect(layers_, &QAction::triggered, this, [this](bool on) {
    session_.endGesture();
    editFlat(session_, framesViewOf(session_.workspace().focus), tr("Overlays and shutters"),
             [on](FlatLook& look) { look.layers = on; });
  });
  interpolate_ = makeInterpolationAction(session_, &bench_.window);
  bench_.addAction(interpolate_, {{"viewMenu", 60, 90}});
  const auto play = [this](bool) {
    FlatView* view = bench_.framesInFocus();
    if (!view) view = grid_.viewAs<FlatView>(flatViewInFocus(session_.workspace()));
    if (view && view->isVisible()) return view->togglePlay();
    if (auto* scene = grid_.viewAs<VolumeView>(session_.workspace().focus)) scene->togglePlay();
  };
  play_ =
      bench_.addAction({"playFrames", tr("Play or stop"), {tr("C")}, "", false, play, {{"viewMenu", 30}}});
  const auto typeNumber = [this](bool) {
    FlatView* view = bench_.flatViewInFocus();
    if (!view) view = grid_.viewAs<FlatView>(flatViewInFocus(session_.workspace()));
    if (view && view->isVisible()) view->typeNumber();
  };
  goToNumber_ = bench_.addAction(
      {"goToNumber", tr("Go to number..."), {tr("G")}, "", false, typeNumber, {{"viewMenu", 30}}});
  bench_.menus.addMenu(slab_, {{"viewMenu", 60, 100}});
  bench_.menus.addMenu(colours_, {{"viewMenu", 60, 110}});
  bench_.menus.addMenu(petUnit_, {{"viewMenu", 60, 120}});
}

void FrameActions::connectFrames() {
  connect(&grid_, &ViewGrid::menuRequested, this, [this](View* view, QPoint global) {
    if (auto* flat = qobject_cast<FlatView*>(view)) showSliceMenu(flat, global);
  });
  whenChanged(session_, this, &FrameActions::showFrameActions, showsOther);
  whenChanged(session_, this, &FrameActions::tellWhyFrames, &Workspace::layout);
}

void FrameActions::setShowAsFrames(bool asFrames) {
  const ViewId focus = session_.workspace().focus;
  const Series* shown = seriesIn(session_.workspace(), focus);
  if (!shown) return;
  const Series series = *shown;
  if (asFrames) return bench_.document.opener.showFrames(series);
  if (!session_.showAgain(series, focus)) bench_.document.opener.read(series);
}

// Tells why a new layout has only frames on screen.
void FrameActions::tellWhyFrames() {
  const Workspace& workspace = session_.workspace();
  const std::vector<ViewId> views = viewsInMain(workspace);
  if (views.size() != 1 || !showsFrames(workspace, views.front()) || workspace.layout == Layout::one) return;
  const Series* series = seriesIn(workspace, views.front());
  if (!series) return;
  tell(
      tr("Shown as frames alone: %1")
          .arg(series->notVolume.empty() ? tr("View > Show as frames is on") : shownText(series->notVolume)));
}

// Updates the actions for the view in focus.
void FrameActions::showFrameActions() {
  const Workspace& workspace = session_.workspace();
  const Series* series = seriesIn(workspace, workspace.focus);
  const bool asFrames = series && showsFrames(workspace, workspace.focus);
  asFrames_->setChecked(asFrames);
  asFrames_->setEnabled(series && frameCount(*series) > 0 && series->notVolume.empty());
  asFrames_->setToolTip(
      toolTipOf(series && !series->notVolume.empty() ? shownText(series->notVolume) : asFrames_->text()));
  layers_->setEnabled(asFrames);
  layers_->setChecked(flatLookOf(workspace.view(framesViewOf(workspace.focus))).layers);
  ownWindows_->setEnabled(asFrames && frameCount(*series) > 1);
  ownWindows_->setChecked(asFrames && hasOwnWindows(workspace.series.at(keyOf(*series)), *series));
  const bool isStack = asFrames
                           ? frameCount(*series) > 1
                           : series && std::ranges::any_of(viewsOnScreen(workspace), [&](ViewId id) {
                               return isFlat(workspace.view(id).kind) && !workspace.view(id).series.empty();
                             });
  goToNumber_->setEnabled(isStack);
  play_->setEnabled(isStack || (series && hasTimePoints(workspace, keyOf(*series))));
}

void FrameActions::showSliceMenu(FlatView* view, QPoint global) {
  auto* menu = new QMenu(view->window());
  menu->setObjectName(QStringLiteral("flatMenu"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  auto* frames = qobject_cast<FrameView*>(view);
  menu->addAction(interpolate_);
  bench_.sliceMenuOpens(menu, view);
  menu->addSeparator();
  if (!frames) {
    menu->addMenu(slab_);
    menu->addMenu(colours_);
    menu->addMenu(bench_.shared.overlays);
  }
  if (const Series* series = seriesIn(session_.workspace(), view->id()); series && series->modality == "PT")
    menu->addMenu(petUnit_);
  menu->addActions({asFrames_, ownWindows_, layers_, play_});
  menu->popup(global);
}

}  // namespace

std::unique_ptr<Feature> makeFrameActions(Workbench& bench) { return std::make_unique<FrameActions>(bench); }

}  // namespace volumen
