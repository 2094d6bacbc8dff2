#include "ui/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QComboBox>
#include <QDockWidget>
#include <QMimeData>
#include <QSettings>
#include <QStackedWidget>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>

#include "ui/controller/qt_gl_context.h"
#include "ui/controller/table_remover.h"
#include "ui/panels/accuracy_panel.h"
#include "ui/panels/effects_panel.h"
#include "ui/panels/segment_panel.h"
#include "ui/panels/snapshot_panel.h"
#include "ui/panels/studies_panel.h"
#include "ui/session/text.h"
#include "ui/views/volume_view.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/start_page.h"
#include "ui/widgets/status_line.h"

namespace volumen {

MainWindow::MainWindow(const Services& services, QWidget* parent)
    : QMainWindow(parent),
      services_(services),
      controller_(services.makeDraw),
      loader_(services.makeScene),
      meter_(controller_),
      snapshot_(controller_) {
  setObjectName(QStringLiteral("mainWindow"));
  setWindowTitle(QStringLiteral("volumen"));
  setAcceptDrops(true);
  setDockOptions(AnimatedDocks | AllowTabbedDocks | AllowNestedDocks);
  resize(1440, 900);
  makeCentre();
  makeDocks();
  makeActions();
  makeMenus();
  makeToolBar();
  connectSession();
  connectLoader();
  connectDrawing();
  connectSegmenter();
  connectTableRemover();
  connectAccuracy();
  restoreLayout();
}

MainWindow::~MainWindow() {
  // Panels and view refer to the session: they go first.
  for (const auto& [name, dock] : docks_) delete dock;
  delete takeCentralWidget();
}

void MainWindow::makeCentre() {
  view_ = new VolumeView(session_);
  banner_ = new Banner;
  auto* start = new StartPage;
  pages_ = new QStackedWidget;
  pages_->addWidget(start);
  pages_->addWidget(view_);
  auto* centre = new QWidget;
  auto* column = new QVBoxLayout(centre);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(banner_);
  column->addWidget(pages_, 1);
  setCentralWidget(centre);
  status_ = new StatusLine;
  statusBar()->addWidget(status_, 1);
  statusBar()->setSizeGripEnabled(false);
  connect(start, &StartPage::openFolderRequested, this, &MainWindow::askForFolder);
  connect(start, &StartPage::openFileRequested, this, &MainWindow::askForFile);
  connect(start, &StartPage::sampleRequested, this, [this] { open({QStringLiteral("phantom:ct-head")}); });
}

void MainWindow::connectSession() {
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.series != after.series)
      areOneSeries(before.series, after.series) ? showVolume() : showSeries();
    if (before.wish != after.wish) applyLevel();
    if (before.series == after.series && before.scene == after.scene) return;
    meter_.forget();
    requestFrame();
  });
  connect(view_, &VolumeView::pixelsChanged, this, &MainWindow::requestFrame);
  connect(view_, &VolumeView::hovered, status_, &StatusLine::showHover);
  connect(view_, &VolumeView::maximiseRequested, this,
          [this] { actions_[QStringLiteral("maximise")]->toggle(); });
}

void MainWindow::connectLoader() {
  connect(&loader_, &Loader::studyOpened, this, &MainWindow::showStudy);
  connect(&loader_, &Loader::seriesLoaded, &session_, &Session::show);
  connect(&loader_, &Loader::presetReady, this,
          [this](const QString& name, const Scene& scene, const VolumePtr& v) {
            if (session_.series() && session_.series()->volume == v) applyPreset(name, scene);
          });
  connect(&loader_, &Loader::failed, this, [this](const QString& sentence) { banner_->tell(sentence); });
  connect(&loader_, &Loader::progressed, status_, &StatusLine::progress);
  connect(&loader_, &Loader::busyChanged, this, [this](bool busy) {
    if (busy)
      status_->begin(tr("opening"));
    else
      status_->end();
  });
  connect(status_, &StatusLine::cancelRequested, this, [this] {
    loader_.cancel();
    snapshot_.cancel();
    tableRemover_->cancel();
  });
  connect(studies_, &StudiesPanel::seriesChosen, &loader_, &Loader::load);
  connect(studies_, &StudiesPanel::seriesRemoved, this, [this](const Series& gone) {
    const ShownSeriesPtr& shown = session_.series();
    if (shown && shown->series.id == gone.id && shown->series.path == gone.path) session_.show(nullptr);
  });
  connect(studies_, &StudiesPanel::allClosed, this, [this] {
    loader_.cancel();
    banner_->hide();
    session_.show(nullptr);
  });
}

void MainWindow::connectDrawing() {
  connect(&controller_, &RenderController::frameReady, this, &MainWindow::showFrame);
  connect(&controller_, &RenderController::failed, this,
          [this](const QString& sentence) { banner_->tell(sentence); });
  connect(snapshotPanel_, &SnapshotPanel::saveRequested, this, &MainWindow::saveSnapshot);
  connect(&snapshot_, &Snapshot::begun, this, [this] { status_->begin(tr("drawing the picture to save")); });
  connect(&snapshot_, &Snapshot::saved, this, [this](const QString& path) {
    status_->end();
    status_->tell(tr("Saved %1").arg(path));
  });
  connect(&snapshot_, &Snapshot::failed, this, [this](const QString& sentence) {
    status_->end();
    banner_->tell(sentence);
  });
}

void MainWindow::connectSegmenter() {
  connect(segment_, &SegmentPanel::segmentRequested, &segmenter_, &Segmenter::segment);
  connect(segment_, &SegmentPanel::saveRequested, &segmenter_, &Segmenter::save);
  connect(&segmenter_, &Segmenter::segmented, segment_, &SegmentPanel::showSegmentation);
  connect(&segmenter_, &Segmenter::saved, this,
          [this](const QString& path) { status_->tell(tr("Saved %1").arg(path)); });
  connect(&segmenter_, &Segmenter::failed, this,
          [this](const QString& sentence) { banner_->tell(sentence); });
}

void MainWindow::connectTableRemover() {
  segment_->setTableAction(tableRemover_);
  connect(tableRemover_, &TableRemover::begun, this, [this] { status_->begin(tr("Removing table")); });
  connect(tableRemover_, &TableRemover::ended, status_, &StatusLine::end);
  connect(tableRemover_, &TableRemover::failed, this,
          [this](const QString& sentence) { banner_->tell(sentence); });
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
  connect(showError, &QAction::toggled, view_, &VolumeView::setErrorShown);
  snapshot_.setMeasured([this](const Plan& plan) { return measuredError(meter_.measured(), plan); });
}

void MainWindow::applyLevel() {
  meter_.setNeeded(session_.wish().aim != Aim::level);
  const auto level = levelFor(session_.wish(), meter_.measured().levels);
  if (!level || *level == controller_.level()) return;
  controller_.setLevel(*level);
  accuracy_->showLevel(*level);
  requestFrame();
}

void MainWindow::open(const QStringList& paths) {
  banner_->hide();
  showFirst_ = true;
  for (const QString& path : paths) loader_.open(path);
}

void MainWindow::showStudy(const QString& path, const std::shared_ptr<const Study>& study) {
  studies_->addStudy(path, study);
  QStringList details;
  for (const Refused& refused : study->refused)
    details << shownText(refused.path) + QStringLiteral(": ") + shownText(refused.reason);
  for (const Other& other : study->other)
    details << shownText(other.path) + QStringLiteral(": ") + shownText(other.kind);
  if (study->volumes.empty())
    return banner_->tell(tr("%1 holds no image that can be shown.").arg(shownText(path.toStdString())),
                         details);
  if (!study->refused.empty())
    banner_->tell(study->refused.size() == 1 ? tr("1 file could not be read.")
                                             : tr("%1 files could not be read.").arg(study->refused.size()),
                  details);
  if (!std::exchange(showFirst_, false)) return;
  if (const Result<std::size_t> largest = chooseSeries(*study, {})) loader_.load(study->volumes[*largest]);
}

// The volume of the series on screen and what is to be known of it.
void MainWindow::showVolume() {
  const ShownSeriesPtr& series = session_.series();
  controller_.setVolume(series ? series->volume : nullptr);
  QStringList warnings;
  if (series)
    for (const std::string& warning : series->warnings) warnings << shownText(warning);
  status_->showWarnings(warnings);
}

void MainWindow::showSeries() {
  const ShownSeriesPtr& series = session_.series();
  showVolume();
  pages_->setCurrentWidget(series ? static_cast<QWidget*>(view_) : pages_->widget(0));
  if (!series) return setWindowTitle(QStringLiteral("volumen"));
  QStringList parts{patientText(series->series), seriesText(series->series), QStringLiteral("volumen")};
  parts.removeAll(QString());
  setWindowTitle(parts.join(QStringLiteral(" - ")));
  studies_->markShown(series);
  presets_->setCurrentIndex(0);
  snapshotPanel_->setName(seriesText(series->series).replace(QLatin1Char('/'), QLatin1Char('_')) +
                          QStringLiteral(".png"));
  view_->setFocus();
}

void MainWindow::requestFrame() {
  if (!session_.series() || pages_->currentWidget() != view_) return;
  snapshotPanel_->setViewSize(view_->pixels());
  controller_.request(session_.scene(), view_->pixels());
}

void MainWindow::setResampler(Resampler resampler) {
  // Where Qt has no OpenGL without a window, EGL is tried when the picture is drawn.
  if (resampler == Resampler::gl) makeOffscreenGlSurface();
  controller_.setResampler(resampler);
  meter_.forget();
  requestFrame();
}

void MainWindow::showFrame(const Frame& frame) {
  const QString ms = QString::number(frame.ms, 'f', frame.ms < 10 ? 1 : 0);
  QString level = QLatin1String(qualityName(frame.quality));
  if (frame.factor > 1) level += QStringLiteral(" 1/%1").arg(frame.factor);
  view_->setPicture(frame.image, tr("%1 - %2 ms").arg(level, ms), frame.error);
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
  Q_EMIT settled();
}

void MainWindow::applyPreset(const QString& name, const Scene& scene) {
  session_.edit(tr("Preset %1").arg(name), [&](Scene& s) {
    s.mode = scene.mode;
    s.window = scene.window;
    s.transferFunction = scene.transferFunction;
    s.shading = scene.shading;
    s.lights = scene.lights;
  });
}

void MainWindow::saveSnapshot(const SnapshotRequest& request) {
  if (!session_.series()) return banner_->tell(tr("Nothing is open to be saved: open a series first."));
  Scene scene = session_.scene();
  scene.camera = view_->camera();
  if (request.transparent) scene.background = {.transparent = true, .colour = {}};
  RenderOptions options;
  options.size = {request.size.width(), request.size.height()};
  options.quality = request.quality;
  snapshot_.save(scene, options, request.path);
}

void MainWindow::setMaximised(bool alone) {
  if (alone) layoutBefore_ = saveState();
  for (const auto& [name, dock] : docks_) dock->setVisible(!alone);
  for (QToolBar* bar : findChildren<QToolBar*>()) bar->setVisible(!alone);
  statusBar()->setVisible(!alone);
  if (!alone) restoreState(layoutBefore_);
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

void MainWindow::restoreLayout() {
  const QSettings settings;
  restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
  restoreState(settings.value(QStringLiteral("window/layout")).toByteArray());
  const bool light = settings.value(QStringLiteral("theme")).toString() == QStringLiteral("light");
  actions_[QStringLiteral("lightTheme")]->setChecked(light);
  setTheme(light ? Theme::light : Theme::dark);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  QSettings settings;
  actions_[QStringLiteral("maximise")]->setChecked(false);
  settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
  settings.setValue(QStringLiteral("window/layout"), saveState());
  event->accept();
}

}  // namespace volumen
