#include "ui/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDir>
#include <QDockWidget>
#include <QFileInfo>
#include <QMessageBox>
#include <QMimeData>
#include <QStackedWidget>
#include <QStatusBar>
#include <QVBoxLayout>

#include "io/files/session_file.h"
#include "ui/controller/find_saved.h"
#include "ui/controller/masker.h"
#include "ui/controller/qt_gl_context.h"
#include "ui/controller/registrar.h"
#include "ui/data/frame_series.h"
#include "ui/panels/accuracy_panel.h"
#include "ui/panels/effects_panel.h"
#include "ui/panels/preset_bar.h"
#include "ui/panels/segment_panel.h"
#include "ui/panels/snapshot_panel.h"
#include "ui/panels/studies_panel.h"
#include "ui/panels/study_model.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/offer_bar.h"
#include "ui/widgets/start_page.h"
#include "ui/widgets/status_line.h"
#include "ui/workspace/hidden_paths.h"
#include "ui/workspace/series_text.h"
#include "ui/workspace/text.h"
#include "ui/workspace/time_points.h"

namespace volumen {

MainWindow::MainWindow(const Services& services, QWidget* parent)
    : QMainWindow(parent),
      services_(services),
      index_(services.indexFolder, jobs_),
      drawService_(services.makeDraw),
      loader_(jobs_, services.makeScene),
      meter_(drawService_),
      snapshot_(drawService_, jobs_),
      thumbnails_(drawService_, services.makeScene) {
  setObjectName(QStringLiteral("mainWindow"));
  setWindowTitle(QStringLiteral("volumen"));
  setAcceptDrops(true);
  setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
  makeCentre();
  makeReferenceActions();
  makeDocks();
  makeActions();
  makeLayoutActions();
  makeFrameActions();
  makeKindActions();
  makeMeasureActions();
  makeBrowserActions();
  makeMenus();
  makeToolBar();
  connectSession();
  connectLoader();
  connectDrawing();
  connectVolumeViews();
  connectSegmenter();
  connectMasker();
  connectAccuracy();
  connectSnapshots();
  connectScenes();
  connectRecent();
  connectSessions();
  connectViews();
  connectFrames();
  connectLinks();
  connectReferences();
  connectBrowser();
  restoreLayout();
  showTheme();
  session_.prefer(storedPreferences());
}

MainWindow::~MainWindow() {
  // Panels and view refer to the session: they go first.
  for (const auto& [name, dock] : docks_) delete dock;
  delete takeCentralWidget();
  // Their jobs stand in the list.
  delete registrar_;
  delete masker_;
}

void MainWindow::makeCentre() {
  grid_ = new ViewGrid(session_, drawService_, slices_, frames_, measurer_, references_);
  banner_ = new Banner;
  banner_->setWriting(withoutPaths);
  offer_ = new OfferBar;
  start_ = new StartPage;
  pages_ = new QStackedWidget;
  pages_->addWidget(start_);
  pages_->addWidget(grid_);
  auto* centre = new QWidget;
  auto* column = new QVBoxLayout(centre);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(offer_);
  column->addWidget(banner_);
  column->addWidget(makeBrowser(), 1);
  setCentralWidget(centre);
  status_ = new StatusLine(jobs_);
  statusBar()->addWidget(status_, 1);
  statusBar()->setSizeGripEnabled(false);
  connect(start_, &StartPage::openFolderRequested, this, &MainWindow::askForFolder);
  connect(start_, &StartPage::openFileRequested, this, &MainWindow::askForFile);
  connect(start_, &StartPage::sampleRequested, this, [this] { open({QStringLiteral("phantom:ct-head")}); });
}

void MainWindow::connectSession() {
  connect(&session_, &Session::preferencesChanged, this, &MainWindow::applyPreferences);
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.series != after.series)
      before.series&& areOneSeries(before.series, after.series) ? showVolume() : showSeries();
    if (before.goal != after.goal) applyLevel();
    if (before.series == after.series && before.scene == after.scene) return;
    meter_.forget();
  });
  connect(&session_, &Session::workspaceChanged, this, &MainWindow::showWarnings);
}

void MainWindow::connectLoader() {
  connect(&loader_, &Loader::studyOpened, this, &MainWindow::showStudy);
  connect(&loader_, &Loader::seriesLoaded, this,
          [this](const ShownSeriesPtr& series, const std::optional<Scene>& scene) {
            session_.take(series, arrangedFor(series->series));
            if (scene) session_.edit(tr("Open scene"), *scene);
          });
  connect(&loader_, &Loader::presetReady, this,
          [this](const QString& name, const Scene& scene, const VolumePtr& v) {
            if (session_.series() && session_.series()->volume == v)
              session_.choosePreset(tr("Preset %1").arg(name), name.toStdString(), scene);
          });
  connect(&loader_, &Loader::failed, this, [this](const QString& sentence) { banner_->add(sentence); });
  connect(&loader_, &Loader::notLoaded, grid_, &ViewGrid::giveUpWaiting);
  connect(studies_, &StudiesPanel::seriesChosen, this, &MainWindow::showInFocus);
  connect(grid_, &ViewGrid::dropped, this, [this](const QMimeData& what) {
    if (const Series* series = studies_->seriesOf(what)) showInFocus(*series);
    if (const auto choice = choiceIn(what)) index_.open(*choice, OpenHow::here);
  });
  connect(&session_, &Session::seriesNeeded, &loader_,
          [this](const Series& series) { loader_.load(series); });
  connect(studies_, &StudiesPanel::removeRequested, &session_, &Session::close);
  connect(studies_, &StudiesPanel::closeAllRequested, this, [this](const Unlisted& listed) {
    loader_.cancel();
    banner_->hide();
    session_.closeAll(listed);
  });
  connect(&session_, &Session::workspaceChanged, &open_,
          [this](const Workspace& before, const Workspace& after) {
            if (before.unlisted != after.unlisted) open_.setUnlisted(*after.unlisted);
          });
}

void MainWindow::showInFocus(const Series& series) {
  if (opensAsPictures(series)) return showFramesInFocus(series);
  const Workspace& workspace = session_.workspace();
  const Series* shown = seriesIn(workspace, workspace.focus);
  if (shown && !showsFrames(workspace, workspace.focus) && keyOf(*shown) != keyOf(series) &&
      workspace.series.contains(keyOf(series)) && areTimePoints(*shown, series)) {
    session_.endGesture();
    return session_.change(tr("Time point"), withTimePoint(workspace, workspace.focus, keyOf(series)));
  }
  const Session::Arrange arrange = arrangedFor(series);
  if (!session_.showAgain(series, session_.workspace().focus, arrange)) loader_.load(series);
}

void MainWindow::connectDrawing() {
  connect(&drawService_, &DrawService::failed, this,
          [this](ViewId, const QString& sentence) { banner_->tell(sentence); });
}

void MainWindow::connectSegmenter() {
  connect(segment_, &SegmentPanel::segmentRequested, &segmenter_, &Segmenter::segment);
  connect(segment_, &SegmentPanel::saveRequested, &segmenter_, &Segmenter::save);
  connect(&segmenter_, &Segmenter::segmented, segment_, &SegmentPanel::showSegmentation);
  connect(segment_, &SegmentPanel::previewChanged, grid_, &ViewGrid::showSegment);
  connect(&segmenter_, &Segmenter::saved, this,
          [this](const QString& path, const std::shared_ptr<const RangeSegment>& segmentation) {
            status_->tell(tr("Saved %1").arg(path));
            segment_->noteSaved(segmentation);
          });
  connect(&segmenter_, &Segmenter::failed, this,
          [this](const QString& sentence) { banner_->tell(sentence); });
}

void MainWindow::connectMasker() {
  segment_->setTableAction(masker_->tableAction());
  connect(masker_, &Masker::failed, this, [this](const QString& sentence) { banner_->tell(sentence); });
}

void MainWindow::connectAccuracy() {
  connect(&meter_, &AccuracyMeter::changed, this, [this] {
    accuracy_->showMeasured(meter_.measured());
    applyLevel();
  });
  connect(&meter_, &AccuracyMeter::progressed, accuracy_, &AccuracyPanel::showProgress);
  connect(docks_.at(QStringLiteral("accuracy")), &QDockWidget::visibilityChanged, &meter_,
          &AccuracyMeter::setWatched);
  QAction* showError = actions_.at(QStringLiteral("showError"));
  connect(accuracy_, &AccuracyPanel::errorWanted, showError, &QAction::setChecked);
  connect(showError, &QAction::toggled, accuracy_, &AccuracyPanel::setErrorWanted);
  connect(showError, &QAction::toggled, grid_, &ViewGrid::setErrorShown);
}

void MainWindow::applyLevel() {
  meter_.setNeeded(session_.goal().aim != Aim::level);
  const auto level = levelFor(session_.goal(), meter_.measured().levels);
  if (!level || *level == drawService_.level(sceneViewId)) return;
  for (ViewId id = 0; id < viewCount; ++id) drawService_.setLevel(id, *level);
  accuracy_->showLevel(*level);
  grid_->requestPictures();
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

// What was taken off the list stands there again.
void MainWindow::addStudy(const QString& path, const std::shared_ptr<const Study>& study) {
  std::vector<SeriesKey> series;
  std::vector<ReferenceKey> references;
  for (const Series& s : allSeriesOf(*study)) series.push_back(keyOf(s));
  for (const Reference& object : study->references) references.push_back(keyOf(object));
  session_.list(series, references);
  open_.add(path, study);
}

void MainWindow::showStudy(const QString& path, const std::shared_ptr<const Study>& study,
                           const OpenIntent& intent) {
  addStudy(path, study);
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
  if (intent.isShown && !std::exchange(*intent.isShown, true)) showFirst(*study, intent.scene);
}

// The largest volume, else the first pictures.
void MainWindow::showFirst(const Study& study, const std::optional<Scene>& scene) {
  if (const Result<std::size_t> largest = chooseSeries(study, {}); largest && !study.volumes.empty()) {
    const Series& series = study.volumes[*largest];
    return opensAsPictures(series) && !scene ? showFramesInFocus(series) : loader_.load(series, scene);
  }
  if (const std::vector<Series> frames = frameSeries(study); !frames.empty())
    showFramesInFocus(frames.front());
}

void MainWindow::showVolume() {
  thumbnails_.stop();
  thumbnailsOf_.reset();
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

void MainWindow::showSeries() {
  showVolume();
  showPage();
}

void MainWindow::setResampler(Resampler resampler) {
  // Where Qt has no OpenGL without a window, EGL is tried when the picture is drawn.
  if (resampler == Resampler::gl) makeOffscreenGlSurface();
  drawService_.setResampler(resampler);
  meter_.forget();
  grid_->requestPictures();
}

// Once the first picture of a series is there.
void MainWindow::drawThumbnails() {
  const VolumePtr& volume = session_.series()->volume;
  if (std::exchange(thumbnailsOf_, volume) == volume) return;
  thumbnails_.start(volume, presets_->names(), int(PresetBar::thumbnailEdge * devicePixelRatioF()));
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

void MainWindow::closeEvent(QCloseEvent* event) {
  const QString lost = unsavedText();
  if (!closesUnasked_ && !lost.isEmpty()) {
    event->ignore();
    if (!findChild<QMessageBox*>(QStringLiteral("closeBox"))) askBeforeClosing(lost);
    return;
  }
  actions_[QStringLiteral("maximise")]->setChecked(false);
  keepLayout();
  event->accept();
}

}  // namespace volumen
