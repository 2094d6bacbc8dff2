#include <QMenu>
#include <algorithm>

#include "ui/data/frame_series.h"
#include "ui/features/feature.h"
#include "ui/panels/flat_menus.h"
#include "ui/panels/pet_unit_menu.h"
#include "ui/panels/slab_menu.h"
#include "ui/tools/tool.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/frame_look.h"
#include "ui/workspace/text.h"
#include "ui/workspace/time_points.h"
#include "ui/workspace/view_window.h"

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
  void showSliceMenu(FlatView* view, QPoint global);
};

FrameActions::FrameActions(Workbench& bench) : Feature(bench) {
  makeActions();
  connectFrames();
  showFrameActions();
}

void FrameActions::makeActions() {
  // These actions follow what is shown, so only a click triggers them.
  const auto add = [this](const char* name, const QString& text) {
    return bench_.addAction({name, text, {}, "", true, {}, {{"viewMenu", 30}}});
  };
  connect(add("showAsFrames", tr("Show as frames")), &QAction::triggered, this,
          &FrameActions::setShowAsFrames);
  connect(add("ownWindows", tr("Each image its own window")), &QAction::triggered, this, [this](bool on) {
    session_.endGesture();
    session_.change(tr("Each image its own window"), [&](Workspace& w) {
      const ViewId view = framesViewOf(w.focus);
      w.series.edit(w.view(view).series).frameWindow = on ? FrameWindow::ofEach : FrameWindow::ofSeries;
      setWindow(w, view, ChosenWindow());
    });
  });
  connect(add("overlaysAndShutters", tr("Overlays and shutters")), &QAction::triggered, this,
          [this](bool on) {
            session_.endGesture();
            editFlat(session_, framesViewOf(session_.workspace().focus), tr("Overlays and shutters"),
                     [on](FlatLook& look) { look.layers = on; });
          });
  QAction* interpolate = makeInterpolationAction(session_, &bench_.window);
  bench_.addAction(interpolate, {{"viewMenu", 60, 90}});
  const auto play = [this](bool) {
    FlatView* view = bench_.framesInFocus();
    if (!view) view = grid_.viewAs<FlatView>(flatViewInFocus(session_.workspace()));
    if (view && view->isVisible()) return view->togglePlay();
    if (auto* scene = grid_.viewAs<VolumeView>(session_.workspace().focus)) scene->togglePlay();
  };
  bench_.addAction({"playFrames", tr("Play or stop"), {tr("C")}, "", false, play, {{"viewMenu", 30}}});
  const auto typeNumber = [this](bool) {
    FlatView* view = bench_.flatViewInFocus();
    if (!view) view = grid_.viewAs<FlatView>(flatViewInFocus(session_.workspace()));
    if (view && view->isVisible()) view->typeNumber();
  };
  bench_.addAction(
      {"goToNumber", tr("Go to number..."), {tr("G")}, "", false, typeNumber, {{"viewMenu", 30}}});
  bench_.menus.addMenu(makeSlabMenu(session_, &bench_.window), {{"viewMenu", 60, 100}});
  bench_.menus.addMenu(makeColourMenu(session_, &bench_.window), {{"viewMenu", 60, 110}});
  bench_.menus.addMenu(makePetUnitMenu(session_, &bench_.window), {{"viewMenu", 60, 120}});
}

void FrameActions::connectFrames() {
  connect(&grid_, &ViewGrid::menuRequested, this, [this](View* view, QPoint global) {
    if (auto* flat = qobject_cast<FlatView*>(view)) showSliceMenu(flat, global);
  });
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            if (!showsOther(before, after)) return;
            showFrameActions();
            const std::vector<ViewId> views = viewsInMain(after);
            const bool isAlone = views.size() == 1 && showsFrames(after, views.front());
            if (before.layout == after.layout || !isAlone || after.layout == Layout::one) return;
            const Series* series = seriesIn(after, views.front());
            if (!series) return;
            const QString why =
                series->notVolume.empty() ? tr("View > Show as frames is on") : shownText(series->notVolume);
            tell(tr("Shown as frames alone: %1").arg(why));
          });
}

void FrameActions::setShowAsFrames(bool asFrames) {
  const ViewId focus = session_.workspace().focus;
  const Series* shown = seriesIn(session_.workspace(), focus);
  if (!shown) return;
  const Series series = *shown;
  if (asFrames) return bench_.document.opener.showFrames(series);
  if (!session_.showAgain(series, focus)) bench_.document.opener.read(series);
}

// Updates the actions for the view in focus.
void FrameActions::showFrameActions() {
  const Workspace& workspace = session_.workspace();
  const Series* series = seriesIn(workspace, workspace.focus);
  const bool asFrames = series && showsFrames(workspace, workspace.focus);
  QAction* kind = bench_.actions.at(QStringLiteral("showAsFrames"));
  kind->setChecked(asFrames);
  kind->setEnabled(series && frameCount(*series) > 0 && series->notVolume.empty());
  kind->setToolTip(
      toolTipOf(series && !series->notVolume.empty() ? shownText(series->notVolume) : kind->text()));
  QAction* layers = bench_.actions.at(QStringLiteral("overlaysAndShutters"));
  layers->setEnabled(asFrames);
  layers->setChecked(flatLookOf(workspace.view(framesViewOf(workspace.focus))).layers);
  QAction* own = bench_.actions.at(QStringLiteral("ownWindows"));
  own->setEnabled(asFrames && frameCount(*series) > 1);
  own->setChecked(asFrames && hasOwnWindows(workspace.series.at(keyOf(*series)), *series));
  const bool isStack = asFrames
                           ? frameCount(*series) > 1
                           : series && std::ranges::any_of(viewsOnScreen(workspace), [&](ViewId id) {
                               return isFlat(workspace.view(id).kind) && !workspace.view(id).series.empty();
                             });
  bench_.actions.at(QStringLiteral("goToNumber"))->setEnabled(isStack);
  bench_.actions.at(QStringLiteral("playFrames"))
      ->setEnabled(isStack || (series && hasTimePoints(workspace, keyOf(*series))));
}

void FrameActions::showSliceMenu(FlatView* view, QPoint global) {
  auto* menu = new QMenu(view->window());
  menu->setObjectName(QStringLiteral("flatMenu"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  auto* frames = qobject_cast<FrameView*>(view);
  menu->addAction(bench_.action("interpolate"));
  bench_.sliceMenuOpens(menu, view);
  menu->addSeparator();
  const auto add = [&](const char* name) {
    menu->addMenu(bench_.window.findChild<QMenu*>(QLatin1String(name)));
  };
  if (!frames)
    for (const char* name : {"slabMenu", "colourMenu", "overlayMenu"}) add(name);
  if (const Series* series = seriesIn(session_.workspace(), view->id()); series && series->modality == "PT")
    add("petUnitMenu");
  for (const char* name : {"showAsFrames", "ownWindows", "overlaysAndShutters", "playFrames"})
    menu->addAction(bench_.action(name));
  menu->popup(global);
}

}  // namespace

std::unique_ptr<Feature> makeFrameActions(Workbench& bench) { return std::make_unique<FrameActions>(bench); }

}  // namespace volumen
