#include <QActionGroup>
#include <QMenu>
#include <QStackedWidget>

#include "ui/controller/masker.h"
#include "ui/main_window.h"
#include "ui/panels/accuracy_panel.h"
#include "ui/panels/effects_panel.h"
#include "ui/panels/snapshot_panel.h"
#include "ui/views/view_grid.h"

namespace volumen {

VolumeView* MainWindow::view() const { return grid_->volumeView(sceneViewOf(session_.workspace())); }

void MainWindow::connectVolumeViews() {
  const auto tellSize = [this] {
    if (view()->isVisible()) snapshotPanel_->setViewSize(view()->pixels());
  };
  const auto connectOne = [this, tellSize](VolumeView* made) {
    connect(made, &View::pixelsChanged, this, tellSize);
    connect(made, &VolumeView::drawn, this, &MainWindow::showDrawn);
    connect(made, &VolumeView::lassoDrawn, masker_, &Masker::cut);
  };
  connectOne(grid_->volumeView(sceneViewId));
  connect(grid_, &ViewGrid::volumeViewMade, this, connectOne);
  connect(&session_, &Session::workspaceChanged, this,
          [this, tellSize](const Workspace& before, const Workspace& after) {
            if (showsOther(before, after)) showKindActions();
            if (before.focus == after.focus) return;
            drawService_.setHand(after.focus);
            if (sceneViewOf(before) == sceneViewOf(after)) return;
            tellSize();
            view()->requestPicture();  // the panels want to know of it
          });
}

// Of the view that the panels work on.
void MainWindow::showDrawn(const ScreenPicture& drawn) {
  if (drawn.view != sceneViewOf(session_.workspace())) return;
  snapshotPanel_->setViewSize(view()->pixels());
  accuracy_->showEstimate(drawn);
  if (drawn.draft()) return;
  effects_->showPlan(*drawn.plan, drawn.stats);
  Scene now = session_.scene();
  if (!now.camera) now.camera = drawn.scene.camera;
  if (now != drawn.scene) return;
  // The plan's camera sees a little more where a ray stands for several pixels.
  Scene complete = drawn.plan->scene;
  const auto target = complete.camera->target;
  complete.camera = drawn.scene.camera;
  if (!complete.camera->target) complete.camera->target = target;
  meter_.show(session_.series()->volume, complete, drawn.image.size());
  drawThumbnails();
  Q_EMIT settled();
}

// What a view to compare shows.
void MainWindow::makeKindActions() {
  const std::tuple<ViewKind, const char*, QString> table[] = {
      {ViewKind::volume, "show3D", tr("3D")},
      {ViewKind::axial, "showAxial", tr("Axial")},
      {ViewKind::coronal, "showCoronal", tr("Coronal")},
      {ViewKind::sagittal, "showSagittal", tr("Sagittal")}};
  kinds_ = new QActionGroup(this);
  for (const auto& [kind, name, text] : table) {
    QAction* action = kinds_->addAction(text);
    action->setObjectName(QLatin1String(name));
    action->setCheckable(true);
    action->setData(int(kind));
    connect(action, &QAction::triggered, this, [this, kind = kind] {
      session_.showAs(session_.workspace().focus, kind);
      showKindActions();
    });
    actions_[action->objectName()] = action;
  }
  showKindActions();
}

void MainWindow::showKindActions() {
  const Workspace& workspace = session_.workspace();
  const ViewState& view = workspace.view(workspace.focus);
  const Series* series = seriesIn(workspace, workspace.focus);
  kinds_->setEnabled(canChangeKind(workspace.focus) && series && series->notVolume.empty());
  for (QAction* action : kinds_->actions()) action->setChecked(action->data().toInt() == int(view.kind));
}

void MainWindow::addKinds(QMenu* menu) const {
  if (kinds_->isEnabled()) menu->addActions(kinds_->actions());
}

void MainWindow::showVolumeMenu(QPoint global) {
  auto* menu = new QMenu(this);
  menu->setObjectName(QStringLiteral("volumeMenu"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  addKinds(menu);
  menu->addSeparator();
  menu->addActions(sceneTools_->actions());
  menu->addSeparator();
  for (const char* name : {"removeTable", "resetScissors", "resetView"})
    menu->addAction(actions_.at(QLatin1String(name)));
  menu->popup(global);
}

}  // namespace volumen
