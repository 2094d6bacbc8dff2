#include <QActionGroup>
#include <QMenu>
#include <QStackedWidget>

#include "ui/controller/masker.h"
#include "ui/main_window.h"
#include "ui/panels/accuracy_panel.h"
#include "ui/panels/effects_panel.h"
#include "ui/panels/snapshot_panel.h"
#include "ui/views/view_grid.h"
#include "viewer/plan/rule_lines.h"

namespace volumen {

VolumeView* MainWindow::view() const { return grid_->volumeView(sceneViewOf(session_.workspace())); }

void MainWindow::connectVolumeViews() {
  const auto connectOne = [this](VolumeView* view) {
    connect(view, &VolumeView::pictureNeeded, this, [this, view] { requestFrame(*view); });
    connect(view, &VolumeView::entered, this, [this, view] { drawService_.setHand(view->id()); });
    connect(view, &VolumeView::lassoDrawn, masker_, &Masker::cut);
  };
  connectOne(grid_->volumeView(sceneViewId));
  connect(grid_, &ViewGrid::volumeViewMade, this, connectOne);
  connect(&drawService_, &DrawService::screenPictureReady, this, &MainWindow::showFrame);
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            showKindActions();
            if (before.focus == after.focus) return;
            drawService_.setHand(after.focus);
            // The panels want to know of its picture.
            if (sceneViewOf(before) != sceneViewOf(after)) requestFrame(*view());
          });
}

// A view that is hidden is not drawn.
void MainWindow::requestFrame(const VolumeView& view) {
  const ShownSeriesPtr series = view.series();
  const bool isShown = series && view.isVisible() && view.state().kind == ViewKind::volume;
  drawService_.show(view.id(), isShown ? series->volume : nullptr);
  if (!isShown) return;
  if (view.id() == sceneViewOf(session_.workspace())) snapshotPanel_->setViewSize(view.pixels());
  drawService_.request(view.id(), session_.sceneOf(view.id()), view.pixels());
}

void MainWindow::requestFrames() {
  for (const ViewId id : viewsOnScreen(session_.workspace()))
    if (session_.workspace().view(id).kind == ViewKind::volume) requestFrame(*grid_->volumeView(id));
}

namespace {

// "draft 1/4", "first: steps of 1 voxel", "final: standard".
QString captionOf(const ScreenPicture& frame) {
  QString level =
      frame.step ? MainWindow::tr("first: steps of %1").arg(QString::fromStdString(inVoxels(*frame.step)))
                 : QString::fromLatin1(qualityName(frame.quality));
  if (frame.factor > 1) level += QStringLiteral(" 1/%1").arg(frame.factor);
  return frame.atRest ? MainWindow::tr("final: %1").arg(level) : level;
}

}  // namespace

void MainWindow::showFrame(const ScreenPicture& frame) {
  const QString ms = QString::number(frame.ms, 'f', frame.ms < 10 ? 1 : 0);
  grid_->volumeView(frame.view)
      ->setPicture(frame.image, tr("%1 - %2 ms").arg(captionOf(frame), ms), frame.error);
  if (frame.view != sceneViewOf(session_.workspace())) return;
  accuracy_->showEstimate(frame);
  if (frame.draft()) return;
  effects_->showPlan(*frame.plan, frame.stats);
  Scene now = session_.scene();
  if (!now.camera) now.camera = frame.scene.camera;
  if (now != frame.scene) return;
  // The plan's camera sees a little more where a ray stands for several pixels.
  Scene complete = frame.plan->scene;
  const auto target = complete.camera->target;
  complete.camera = frame.scene.camera;
  if (!complete.camera->target) complete.camera->target = target;
  meter_.show(session_.series()->volume, complete, frame.image.size());
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
  for (const char* name : {"orbitTool", "curveTool", "scissorsTool"})
    menu->addAction(actions_.at(QLatin1String(name)));
  menu->addSeparator();
  for (const char* name : {"removeTable", "resetScissors", "resetView"})
    menu->addAction(actions_.at(QLatin1String(name)));
  menu->popup(global);
}

}  // namespace volumen
