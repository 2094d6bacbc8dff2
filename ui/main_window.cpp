#include "ui/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDir>
#include <QDockWidget>
#include <QFileInfo>
#include <QMenu>
#include <QMimeData>
#include <QSplitter>
#include <QStackedWidget>
#include <QStatusBar>
#include <QVBoxLayout>

#include "io/files/session_file.h"
#include "ui/data/frame_series.h"
#include "ui/panels/studies_panel.h"
#include "ui/panels/study_model.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/start_page.h"
#include "ui/widgets/status_line.h"
#include "ui/workspace/hidden_paths.h"
#include "ui/workspace/series_text.h"
#include "ui/workspace/text.h"

namespace volumen {

MainWindow::MainWindow(const Services& services, QWidget* parent)
    : QMainWindow(parent), services_(services), document_(services_) {
  setObjectName(QStringLiteral("mainWindow"));
  setWindowTitle(QStringLiteral("volumen"));
  setAcceptDrops(true);
  setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
  makeCentre();
  makeDocks();
  makeActions();
  connectSession();
  connectLoader();
  connectDrawing();
  makeFeatures();
  makeMenus();
  makeToolBar();
  connectRecent();
  restoreLayout();
  showTheme();
  session_.prefer(storedPreferences());
}

MainWindow::~MainWindow() {
  // Panels and views refer to the document, and features' jobs stand in its list: they go first.
  for (const auto& [name, dock] : bench_->docks) delete dock;
  delete takeCentralWidget();
  features_.clear();
}

void MainWindow::makeCentre() {
  grid_ = new ViewGrid(session_, document_.drawService, document_.slices, document_.frames,
                       document_.measurer, document_.references);
  banner_ = new Banner;
  banner_->setWriting(withoutPaths);
  start_ = new StartPage;
  pages_ = new QStackedWidget;
  pages_->addWidget(start_);
  pages_->addWidget(grid_);
  auto* split = new QSplitter(Qt::Vertical);
  split->setObjectName(QStringLiteral("browserSplitter"));
  split->setChildrenCollapsible(false);
  split->addWidget(pages_);
  auto* centre = new QWidget;
  auto* column = new QVBoxLayout(centre);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(banner_);
  column->addWidget(split, 1);
  setCentralWidget(centre);
  status_ = new StatusLine(document_.jobs);
  statusBar()->addWidget(status_, 1);
  statusBar()->setSizeGripEnabled(false);
  bench_ = std::make_unique<Workbench>(
      services_, document_, WindowParts{*this, *grid_, *banner_, *status_, *pages_, *split, *column});
  connect(start_, &StartPage::openFolderRequested, this, &MainWindow::askForFolder);
  connect(start_, &StartPage::openFileRequested, this, &MainWindow::askForFile);
  connect(start_, &StartPage::sampleRequested, this, [this] { open({QStringLiteral("phantom:ct-head")}); });
}

void MainWindow::makeFeatures() {
  for (const FeatureEntry& entry : features()) features_.push_back(entry.make(*bench_));
}

void MainWindow::connectSession() {
  connect(&session_, &Session::preferencesChanged, this, &MainWindow::applyPreferences);
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    const bool isSame = before.series && areOneSeries(before.series, after.series);
    if (before.series != after.series && !isSame) showPage();
  });
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            showWarnings();
            if (!showsOther(before, after)) return;
            choosePage();
            const auto shown = [](const Workspace& w) {
              return std::pair(w.view(w.focus).series, showsFrames(w, w.focus));
            };
            if (shown(before) != shown(after)) showPage();
          });
  connect(&session_, &Session::workspaceChanged, &open_,
          [this](const Workspace& before, const Workspace& after) {
            if (before.unlisted != after.unlisted) open_.setUnlisted(*after.unlisted);
          });
}

void MainWindow::connectLoader() {
  connect(&loader_, &Loader::studyOpened, this, &MainWindow::showStudy);
  connect(&loader_, &Loader::seriesLoaded, this,
          [this](const ShownSeriesPtr& series, const std::optional<Scene>& scene) {
            session_.take(series, document_.opener.arrangedFor(series->series));
            if (scene) session_.edit(tr("Open scene"), *scene);
          });
  connect(&loader_, &Loader::failed, this, [this](const QString& sentence) { banner_->add(sentence); });
  connect(&loader_, &Loader::notLoaded, grid_, &ViewGrid::giveUpWaiting);
  connect(studies_, &StudiesPanel::seriesChosen, &document_.opener, &Opener::show);
  connect(studies_, &StudiesPanel::referenceChosen, bench_.get(), &Workbench::referenceChosen);
  connect(grid_, &ViewGrid::dropped, this, [this](const QMimeData& what) {
    if (const Series* series = studies_->seriesOf(what)) document_.opener.show(*series);
    if (const auto choice = choiceIn(what)) document_.index.open(*choice, OpenHow::here);
  });
  connect(&session_, &Session::seriesNeeded, &loader_,
          [this](const Series& series) { loader_.load(series); });
  connect(studies_, &StudiesPanel::removeRequested, &session_, &Session::close);
  connect(studies_, &StudiesPanel::closeAllRequested, this, [this](const Unlisted& listed) {
    loader_.cancel();
    banner_->hide();
    session_.closeAll(listed);
  });
}

void MainWindow::connectDrawing() {
  connect(&document_.drawService, &DrawService::failed, this,
          [this](ViewId, const QString& sentence) { banner_->tell(sentence); });
  connect(&document_.slices, &SliceService::failed, this,
          [this](int, const QString& sentence) { banner_->tell(sentence); });
  bench_->forEachVolumeView(
      [this](VolumeView* made) { connect(made, &VolumeView::drawn, this, &MainWindow::showDrawn); });
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            if (before.focus == after.focus) return;
            document_.drawService.setHand(after.focus);
            // The panels want to know of it.
            if (sceneViewOf(before) != sceneViewOf(after)) view()->requestPicture();
          });
  connect(bench_->docks.at(QStringLiteral("clip")), &QDockWidget::visibilityChanged, grid_,
          &ViewGrid::setClipShown);
  connect(bench_.get(), &Workbench::openRequested, this, [this](const QStringList& paths) { open(paths); });
  connect(grid_, &ViewGrid::hovered, status_, &StatusLine::showHover);
  connect(grid_, &ViewGrid::maximiseRequested, this, [this] { bench_->action("maximise")->toggle(); });
}

// Of the view that the panels work on.
void MainWindow::showDrawn(const ScreenPicture& drawn) {
  if (drawn.view != sceneViewOf(session_.workspace())) return;
  bench_->drawn(drawn);
  if (drawn.draft()) return;
  Scene now = session_.scene();
  if (!now.camera) now.camera = drawn.scene.camera;
  if (now != drawn.scene) return;
  // The plan's camera sees a little more where a ray stands for several pixels.
  Scene complete = drawn.plan->scene;
  const auto target = complete.camera->target;
  complete.camera = drawn.scene.camera;
  if (!complete.camera->target) complete.camera->target = target;
  bench_->drawnAtRest(drawn, complete);
  Q_EMIT settled();
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

// Of what is in focus: page, and mark in the list.
void MainWindow::showPage() {
  choosePage();
  if (const Series* series = seriesIn(session_.workspace(), session_.workspace().focus)) {
    const ShownSeriesPtr inMemory = session_.seriesOf(session_.workspace().focus);
    studies_->markShown(*series, inMemory ? inMemory->volume : nullptr);
  }
  if (pages_->currentWidget() == grid_ && !grid_->isAncestorOf(focusWidget())) grid_->setFocus();
}

void MainWindow::open(const QStringList& paths, const std::optional<Scene>& scene) {
  banner_->hide();
  OpenIntent intent;
  intent.scene = scene;
  intent.isShown = std::make_shared<bool>(false);
  for (const QString& given : paths) {
    const bool isFile = QFileInfo::exists(given);  // a phantom is none
    const QString path = isFile ? QDir::cleanPath(QFileInfo(given).absoluteFilePath()) : given;
    if (isSessionFile(path.toStdString()))
      loader_.openSession(path);
    else
      loader_.open(path, intent);
  }
}

void MainWindow::showStudy(const QString& path, const std::shared_ptr<const Study>& study,
                           const OpenIntent& intent) {
  document_.opener.list(path, study);
  QStringList details;
  for (const Refused& refused : study->refused)
    details << pathText(refused.path) + QStringLiteral(": ") + shownText(refused.reason);
  for (const Other& other : study->other)
    details << pathText(other.path) + QStringLiteral(": ") + shownText(other.kind);
  const bool hasPictures = !study->volumes.empty() || !study->images.empty();
  if (!hasPictures && !study->references.empty()) return;  // they stand in the list
  if (!hasPictures)
    return banner_->add(tr("No images found in %1.").arg(pathText(path.toStdString())), details);
  if (!study->refused.empty()) banner_->add(unreadText(*study), details);
  recent_.add(path);
  if (intent.isShown && !std::exchange(*intent.isShown, true))
    document_.opener.showFirst(*study, intent.scene);
}

// What is to be known of the series in focus; of frames and of what is still being read, by its headers.
void MainWindow::showWarnings() {
  const Workspace& workspace = session_.workspace();
  const Series* series = seriesIn(workspace, workspace.focus);
  const ShownSeriesPtr read =
      showsFrames(workspace, workspace.focus) ? nullptr : session_.seriesOf(workspace.focus);
  status_->showWarnings(read     ? warningSentences(read->warnings)
                        : series ? warningSentences(series->warnings)
                                 : QStringList());
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

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  QStringList paths;
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) paths << url.toLocalFile();
  if (!paths.isEmpty()) open(paths);
  event->acceptProposedAction();
}

void MainWindow::end() {
  for (const auto& feature : features_) feature->closeUnasked();
  close();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  QStringList lost;
  for (const auto& feature : features_) lost << feature->unsavedText();
  lost.removeAll(QString());
  const auto mayClose = [&](const auto& feature) {
    return feature->mayClose(lost.join(QStringLiteral(", ")));
  };
  if (!std::ranges::all_of(features_, mayClose)) return event->ignore();
  bench_->action("maximise")->setChecked(false);
  keepLayout();
  event->accept();
}

}  // namespace volumen
