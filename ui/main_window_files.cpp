#include <QFileDialog>
#include <QMenu>
#include <QStackedWidget>

#include "ui/main_window.h"
#include "ui/panels/snapshot_panel.h"
#include "ui/views/volume_view.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/start_page.h"
#include "ui/widgets/status_line.h"

namespace volumen {

// The scene as it is seen, whatever size the view has.
Scene MainWindow::sceneInView() const {
  Scene scene = session_.scene();
  scene.camera = view()->camera();
  return scene;
}

void MainWindow::connectSnapshots() {
  snapshot_.setMeasured([this](const Plan& plan) { return measuredError(meter_.measured(), plan); });
  connect(snapshotPanel_, &SnapshotPanel::requested, this, &MainWindow::takeSnapshot);
  connect(&snapshot_, &Snapshot::saved, this, [this](const QString& path, int pictures) {
    status_->tell(pictures == 1 ? tr("Saved %1").arg(path)
                                : tr("Saved %1 pictures, the last as %2").arg(pictures).arg(path));
  });
  connect(&snapshot_, &Snapshot::copied, this, [this] { status_->tell(tr("Copied to the clipboard")); });
  connect(&snapshot_, &Snapshot::failed, this, [this](const QString& sentence) { banner_->tell(sentence); });
}

void MainWindow::takeSnapshot(const SnapshotRequest& request) {
  if (!session_.series()) return banner_->tell(tr("Open a series first."));
  snapshot_.take(session_.series(), sceneInView(), request);
}

void MainWindow::connectScenes() {
  connect(&sceneFiles_, &SceneFiles::opened, this, [this](const Scene& scene) {
    banner_->hide();
    session_.edit(tr("Open scene"), scene);
  });
  connect(&sceneFiles_, &SceneFiles::saved, this,
          [this](const QString& path) { status_->tell(tr("Saved %1").arg(path)); });
  connect(&sceneFiles_, &SceneFiles::failed, this,
          [this](const QString& sentence) { banner_->tell(sentence); });
}

void MainWindow::askForScene() {
  if (!session_.series()) return banner_->tell(tr("Open a series first."));
  auto* dialog = new QFileDialog(this, tr("Open a scene"), {},
                                 tr("Scenes and snapshots (*.json *.png *.jpg *.jpeg);;All files (*)"));
  dialog->setObjectName(QStringLiteral("openSceneDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, &sceneFiles_, &SceneFiles::open);
  dialog->open();
}

void MainWindow::askForSceneFile() {
  if (!session_.series()) return banner_->tell(tr("Open a series first."));
  auto* dialog = new QFileDialog(this, tr("Save the scene"), {}, tr("Scenes (*.json)"));
  dialog->setObjectName(QStringLiteral("saveSceneDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QStringLiteral("json"));
  dialog->selectFile(QStringLiteral("scene.json"));
  connect(dialog, &QFileDialog::fileSelected, this,
          [this](const QString& path) { sceneFiles_.save(path, sceneInView()); });
  dialog->open();
}

void MainWindow::connectRecent() {
  connect(start_, &StartPage::recentRequested, this, [this](const QString& path) { open({path}); });
  connect(start_, &StartPage::clearRecentRequested, &recent_, &RecentFiles::clear, Qt::QueuedConnection);
  connect(&recent_, &RecentFiles::changed, this, &MainWindow::showRecent);
  showRecent();
  recent_.look();
}

void MainWindow::showRecent() {
  recentMenu_->clear();
  QSet<QString> gone;
  for (const QString& path : recent_.paths()) {
    auto* action = recentMenu_->addAction(QString(path).replace(QLatin1Char('&'), QStringLiteral("&&")));
    action->setEnabled(!recent_.isGone(path));
    if (recent_.isGone(path)) gone.insert(path);
    connect(action, &QAction::triggered, this, [this, path] { open({path}); });
  }
  recentMenu_->setEnabled(!recent_.paths().isEmpty());
  recentMenu_->addSeparator();
  auto* clear = recentMenu_->addAction(tr("Clear list"));
  clear->setObjectName(QStringLiteral("clearRecentMenu"));
  connect(clear, &QAction::triggered, &recent_, &RecentFiles::clear, Qt::QueuedConnection);
  start_->showRecent(recent_.paths(), gone);
}

}  // namespace volumen
