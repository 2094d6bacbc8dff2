#include <QAction>
#include <QMenu>
#include <QStackedWidget>

#include "ui/data/frame_series.h"
#include "ui/main_window.h"
#include "ui/panels/flat_menus.h"
#include "ui/panels/slab_menu.h"
#include "ui/panels/studies_panel.h"
#include "ui/tools/tool.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/plain_text.h"
#include "ui/widgets/status_line.h"
#include "ui/workspace/frame_look.h"
#include "ui/workspace/text.h"
#include "ui/workspace/time_points.h"

namespace volumen {

void MainWindow::makeFrameActions() {
  const auto add = [this](const char* name, const QString& text, const QString& key, bool isCheckable) {
    auto* action = new QAction(text, this);
    action->setObjectName(QLatin1String(name));
    if (!key.isEmpty()) action->setShortcut(key);
    action->setCheckable(isCheckable);
    addAction(action);
    return actions_[action->objectName()] = action;
  };
  connect(add("showAsFrames", tr("Show as frames"), {}, true), &QAction::triggered, this,
          &MainWindow::setShowAsFrames);
  connect(add("overlaysAndShutters", tr("Overlays and shutters"), {}, true), &QAction::triggered, this,
          [this](bool on) {
            session_.endGesture();
            editFlat(session_, framesViewOf(session_.workspace().focus), tr("Overlays and shutters"),
                     [on](FlatLook& look) { look.layers = on; });
          });
  connect(add("ownWindows", tr("Each image its own window"), {}, true), &QAction::triggered, this,
          [this](bool on) {
            session_.endGesture();
            session_.change(tr("Each image its own window"), [&](Workspace& w) {
              SeriesState& state = w.series.edit(w.view(framesViewOf(w.focus)).series);
              state.frameWindow = on ? FrameWindow::ofEach : FrameWindow::ofSeries;
              state.window.reset();
              state.namedGrey = 0;
            });
          });
  QAction* interpolate = makeInterpolationAction(session_, this);
  actions_[interpolate->objectName()] = interpolate;
  connect(add("playFrames", tr("Play or stop"), tr("C"), false), &QAction::triggered, this, [this] {
    SliceView* view = framesInFocus();
    if (!view) view = grid_->sliceView(flatViewInFocus(session_.workspace()));
    if (view) view->togglePlay();
  });
}

void MainWindow::connectFrames() {
  connect(grid_, &ViewGrid::menuRequested, this, [this](View* view, QPoint global) {
    if (auto* flat = qobject_cast<SliceView*>(view))
      showFlatMenu(*flat, global);
    else
      showVolumeMenu(global);
  });
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            if (!showsOther(before, after)) return;
            const auto shown = [](const Workspace& w) {
              return std::pair(w.view(w.focus).series, showsFrames(w, w.focus));
            };
            if (shown(before) != shown(after)) showPage();
            showFrameActions();
            const bool isAlone = showsFrames(after, after.focus) && viewsOnScreen(after).size() == 1;
            if (before.layout == after.layout || !isAlone || after.layout == Layout::one) return;
            const Series* series = seriesIn(after, after.focus);
            if (!series) return;
            const QString why =
                series->notVolume.empty() ? tr("View > Show as frames is on") : shownText(series->notVolume);
            status_->tell(tr("Shown as frames alone: %1").arg(why));
          });
  showFrameActions();
}

// The view of frames that keys and the menu are for; null: there is none.
SliceView* MainWindow::framesInFocus() const {
  const ViewId focus = session_.workspace().focus;
  return showsFrames(session_.workspace(), focus) ? grid_->sliceView(framesViewOf(focus)) : nullptr;
}

void MainWindow::showFramesInFocus(const Series& series) {
  loader_.cancelLoad();
  session_.showFrames(series, session_.workspace().focus, [&](Workspace w, bool isNew) {
    return isNew ? withTimePointsOf(std::move(w), series, open_.volumes()) : std::move(w);
  });
}

void MainWindow::setShowAsFrames(bool asFrames) {
  const ViewId focus = session_.workspace().focus;
  const Series* shown = seriesIn(session_.workspace(), focus);
  if (!shown) return;
  const Series series = *shown;
  if (asFrames) return showFramesInFocus(series);
  if (!session_.showAgain(series, focus)) loader_.load(series);
}

// What the actions say of the view in focus.
void MainWindow::showFrameActions() {
  const Workspace& workspace = session_.workspace();
  const Series* series = seriesIn(workspace, workspace.focus);
  const bool asFrames = series && showsFrames(workspace, workspace.focus);
  QAction* kind = actions_.at(QStringLiteral("showAsFrames"));
  kind->setChecked(asFrames);
  kind->setEnabled(series && frameCount(*series) > 0 && series->notVolume.empty());
  kind->setToolTip(
      toolTipOf(series && !series->notVolume.empty() ? shownText(series->notVolume) : kind->text()));
  QAction* layers = actions_.at(QStringLiteral("overlaysAndShutters"));
  layers->setEnabled(asFrames);
  layers->setChecked(flatLookOf(workspace.view(framesViewOf(workspace.focus))).layers);
  QAction* own = actions_.at(QStringLiteral("ownWindows"));
  own->setEnabled(asFrames && frameCount(*series) > 1);
  own->setChecked(asFrames && hasOwnWindows(workspace.series.at(keyOf(*series)), *series));
  actions_.at(QStringLiteral("playFrames"))
      ->setEnabled(asFrames ? frameCount(*series) > 1 : series && hasTimePoints(workspace, keyOf(*series)));
}

// The views where any of them shows something, else the start page.
void MainWindow::choosePage() {
  const Workspace& workspace = session_.workspace();
  const bool isAny = std::ranges::any_of(viewsOnScreen(workspace),
                                         [&](ViewId id) { return !workspace.view(id).series.empty(); });
  const bool appears = isAny && pages_->currentWidget() != grid_;
  pages_->setCurrentWidget(isAny ? static_cast<QWidget*>(grid_) : pages_->widget(0));
  // A page that appears gives the keys to its first child, whatever view has the focus.
  if (appears) grid_->setFocus();
}

// Of what is in focus: page, title, and mark in the list.
void MainWindow::showPage() {
  choosePage();
  showNames();
  if (pages_->currentWidget() == grid_ && !grid_->isAncestorOf(focusWidget())) grid_->setFocus();
}

void MainWindow::showFlatMenu(SliceView& view, QPoint global) {
  auto* menu = new QMenu(this);
  menu->setObjectName(QStringLiteral("flatMenu"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  if (view.showsFrames() && view.frame()) {
    const SeriesState& state = session_.workspace().series.at(view.state().series);
    const std::vector<GreyChoice> choices = greyChoices(*view.frame(), state);
    for (std::size_t n = 0; n < choices.size(); ++n) {
      const QString digit = n < 10 ? QStringLiteral("\t%1").arg(n) : QString();
      QAction* action = menu->addAction(choices[n].name + digit, &view,
                                        [&view, choice = choices[n]] { view.chooseGrey(choice); });
      action->setCheckable(true);
      action->setChecked(withGrey(state, choices[n]) == state);
    }
    if (!choices.empty()) menu->addAction(tr("Invert") + QStringLiteral("\tI"), &view, &SliceView::invert);
    menu->addSeparator();
  }
  menu->addAction(actions_.at(QStringLiteral("interpolate")));
  fillPresentations(menu, view);
  menu->addAction(actions_.at(QStringLiteral("keyImage")));
  addKinds(menu);
  menu->addSeparator();
  if (!view.showsFrames())
    for (const char* name : {"slabMenu", "colourMenu", "overlayMenu"})
      menu->addMenu(findChild<QMenu*>(QLatin1String(name)));
  if (const Series* series = seriesIn(session_.workspace(), view.id()); series && series->modality == "PT")
    menu->addMenu(findChild<QMenu*>(QStringLiteral("petUnitMenu")));
  for (const char* name : {"showAsFrames", "ownWindows", "overlaysAndShutters", "playFrames"})
    menu->addAction(actions_.at(QLatin1String(name)));
  menu->popup(global);
}

}  // namespace volumen
