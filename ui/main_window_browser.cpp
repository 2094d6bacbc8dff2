#include <QApplication>
#include <QFileDialog>
#include <QLabel>
#include <QSplitter>
#include <QStackedWidget>
#include <QStatusBar>
#include <algorithm>

#include "ui/data/frame_series.h"
#include "ui/main_window.h"
#include "ui/panels/studies_panel.h"
#include "ui/panels/study_browser.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/plain_text.h"
#include "ui/widgets/status_line.h"
#include "ui/workspace/indexed_text.h"
#include "ui/workspace/patients.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

// Under which a study of the index stands among what is open.
QString placeOf(std::int64_t study) { return QStringLiteral("index:%1").arg(study); }

bool showsAnything(const Workspace& workspace) {
  return std::ranges::any_of(viewsOnScreen(workspace),
                             [&](ViewId id) { return !workspace.view(id).series.empty(); });
}

// "Doe, Jane (1) and Roe, Rick (2)"
QString joined(const QStringList& names) {
  if (names.size() < 2) return names.join(QString());
  return MainWindow::tr("%1 and %2")
      .arg(names.mid(0, names.size() - 1).join(QStringLiteral(", ")), names.back());
}

QString patientsText(const std::vector<const Series*>& patients) {
  if (patients.size() < 2) return {};
  if (namesHidden()) return MainWindow::tr("The views show %1 different patients.").arg(patients.size());
  QStringList names;
  for (const Series* series : patients) names << patientText(*series);
  return MainWindow::tr("The views show different patients: %1.").arg(joined(names));
}

std::int64_t voxels(const Series& s) {
  return std::int64_t(s.acquired.size.x) * s.acquired.size.y * s.acquired.size.z;
}

}  // namespace

// The studies of the index stand above the views, and in place of them while nothing is open.
QWidget* MainWindow::makeBrowser() {
  browser_ = new StudyBrowser(index_);
  browser_->hide();
  split_ = new QSplitter(Qt::Vertical);
  split_->setObjectName(QStringLiteral("browserSplitter"));
  split_->setChildrenCollapsible(false);
  split_->addWidget(browser_);
  split_->addWidget(pages_);
  split_->setStretchFactor(1, 1);
  patients_ = plainLabel();
  patients_->setObjectName(QStringLiteral("patientsBar"));
  patients_->setWordWrap(true);
  patients_->setStyleSheet(
      QStringLiteral("#patientsBar { background: #4a1720; border-bottom: 2px solid #ff6b6b; color: #ffd9dc;"
                     " padding: 4px 12px; }"));
  patients_->hide();
  auto* centre = new QWidget;
  auto* column = new QVBoxLayout(centre);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(patients_);
  column->addWidget(split_, 1);
  return centre;
}

void MainWindow::makeBrowserActions() {
  const auto add = [this](const char* name, const QString& text, const QKeySequence& key, auto run) {
    auto* action = new QAction(text, this);
    action->setObjectName(QLatin1String(name));
    action->setShortcut(key);
    addAction(action);
    connect(action, &QAction::triggered, this, run);
    return actions_[action->objectName()] = action;
  };
  add("showBrowser", tr("Study list"), tr("Ctrl+B"), [this](bool on) {
    showBrowser(on);
  })->setCheckable(true);
  add("findStudy", tr("Find study..."), QKeySequence::Find, [this] {
    showBrowser(true);
    browser_->startSearch();
  });
  add("importFolder", tr("Import folder..."), tr("Ctrl+I"), [this] { askForImport(); });
}

void MainWindow::connectBrowser() {
  connect(browser_, &StudyBrowser::importRequested, this, &MainWindow::askForImport);
  connect(browser_, &StudyBrowser::hideRequested, this, [this] { showBrowser(false); });
  connect(browser_, &StudyBrowser::openRequested, this, &MainWindow::openIndexed);
  connect(browser_, &StudyBrowser::offlineRequested, this, [this] {
    banner_->tell(
        tr("The files of this study are not there now: connect the disk or network folder that "
           "holds them, or import the folder from where they are."));
  });
  // The first list says whether there is anything to choose from.
  connect(browser_, &StudyBrowser::listChanged, this, [this] {
    if (std::exchange(listedOnce_, true) || browser_->isEmpty()) return;
    if (!loader_.isBusy() && !showsAnything(session_.workspace())) showBrowser(true);
  });
  connect(&index_, &IndexService::filesFound, this, &MainWindow::openFound);
  connect(&index_, &IndexService::failed, this, [this](const QString& sentence) { banner_->tell(sentence); });
  connect(&index_, &IndexService::noticed, this, [this](const QString& sentence) { banner_->add(sentence); });
  connect(&index_, &IndexService::importBegun, this, [this] {
    if (!showsAnything(session_.workspace())) showBrowser(true);
  });
  connect(&index_, &IndexService::importEnded, this, &MainWindow::showImport);
  connect(&loader_, &Loader::filesOpened, this, &MainWindow::showIndexed);
  connect(actions_.at(QStringLiteral("maximise")), &QAction::toggled, this, &MainWindow::arrangeBrowser);
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            if (!showsOther(before, after)) return;
            showPatients();
            if (showsAnything(before) != showsAnything(after))
              showBrowser(!showsAnything(after) && !browser_->isEmpty());
          });
  // Other programs may have changed the list meanwhile.
  connect(qApp, &QGuiApplication::applicationStateChanged, this, [this](Qt::ApplicationState state) {
    if (state == Qt::ApplicationActive) browser_->refresh();
  });
  browser_->refresh();
}

void MainWindow::showBrowser(bool on) {
  QAction* action = actions_.at(QStringLiteral("showBrowser"));
  action->setChecked(on);
  arrangeBrowser();
  if (!on) return;
  browser_->refresh();
  browser_->setFocus();
}

void MainWindow::arrangeBrowser() {
  const bool isShown = actions_.at(QStringLiteral("showBrowser"))->isChecked() &&
                       !actions_.at(QStringLiteral("maximise"))->isChecked();
  const bool any = showsAnything(session_.workspace());
  const bool wereBoth = browser_->isVisibleTo(split_) && pages_->isVisibleTo(split_);
  browser_->setVisible(isShown);
  pages_->setVisible(any || !isShown);
  if (isShown && any && !wereBoth) split_->setSizes({split_->height() * 11 / 20, split_->height() * 9 / 20});
}

void MainWindow::showPatients() {
  const QString text = patientsText(patientsOnScreen(session_.workspace()));
  patients_->setText(text);
  patients_->setVisible(!text.isEmpty());
}

void MainWindow::askForImport() {
  auto* dialog = new QFileDialog(this, tr("Import a folder into the list of studies"));
  dialog->setObjectName(QStringLiteral("importFolderDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::Directory);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) { index_.import({path}); });
  dialog->open();
}

void MainWindow::showImport(const ImportReport& report) {
  status_->tell(importText(report));
  if (report.refused.empty()) return;
  QStringList details;
  for (const Refused& refused : report.refused)
    details << pathText(refused.path) + QStringLiteral(": ") + shownText(refused.reason);
  banner_->tell(report.refused.size() == 1 ? tr("1 file could not be imported.")
                                           : tr("%1 files could not be imported.").arg(report.refused.size()),
                details);
}

// Where it is open already, it is not read again.
void MainWindow::openIndexed(const IndexedChoice& choice, bool beside) {
  index_.open(choice, beside ? OpenHow::beside : OpenHow::instead);
}

void MainWindow::openFound(const IndexedChoice& choice, const std::vector<std::string>& files,
                           const OpenIntent& intent) {
  const QString place = placeOf(choice.study);
  const std::shared_ptr<const Study> open = open_.studyOf(place);
  if (open && std::exchange(filesOf_[place], files) == files) return showIndexed(place, open, intent);
  filesOf_[place] = files;
  loader_.openFiles(place, files, intent);
}

void MainWindow::showIndexed(const QString& place, const std::shared_ptr<const Study>& study,
                             const OpenIntent& intent) {
  addStudy(place, study);
  QStringList details;
  for (const Refused& refused : study->refused)
    details << pathText(refused.path) + QStringLiteral(": ") + shownText(refused.reason);
  if (!study->refused.empty()) banner_->add(unreadText(*study), details);
  showChosen(*study, intent);
}

// The series that was chosen, else the largest volume, else the first pictures.
void MainWindow::showChosen(const Study& study, const OpenIntent& intent) {
  const std::string& uid = intent.seriesUid;
  const auto isChosen = [&](const SeriesIdentity& s) { return uid.empty() || s.seriesUid == uid; };
  const Series* chosen = nullptr;
  for (const Series& series : study.volumes)
    if (isChosen(series) && (!chosen || voxels(series) > voxels(*chosen))) chosen = &series;
  const std::vector<Series> frames = frameSeries(study);
  if (!chosen)
    if (const auto found = std::ranges::find_if(frames, isChosen); found != frames.end()) chosen = &*found;
  if (chosen) return showOpened(Series(*chosen), intent.how);
  for (const ReferencePtr& object : open_.references())
    if (!uid.empty() && object->seriesUid == uid) return showReference(object);
  banner_->add(tr("There is nothing to show in this study."));
}

// In place of other patients, beside what is shown, or in the view in focus.
void MainWindow::showOpened(const Series& series, OpenHow how) {
  if (how == OpenHow::beside) focusNextView();
  const auto isOther = [&](const Series* other) { return !areOfOnePatient(*other, series); };
  const std::vector<const Series*> patients = patientsOnScreen(session_.workspace());
  if (how == OpenHow::instead && std::ranges::any_of(patients, isOther)) {
    session_.makeRoom(tr("Close %1").arg(patientText(*patients.front())),
                      inLayoutOf(withoutOtherPatients(session_.workspace(), series), series));
  }
  showInFocus(series);
  if (how == OpenHow::instead && showsAnything(session_.workspace())) showBrowser(false);
}

// The next view to compare: of two, the other one; of four, the first empty one.
void MainWindow::focusNextView() {
  const Workspace& workspace = session_.workspace();
  if (!showsAnything(workspace)) return;
  const bool compares = workspace.layout == Layout::two || workspace.layout == Layout::four;
  if (!compares) {
    session_.endGesture();
    session_.change(tr("Layout"), withLayout(workspace, Layout::two));
  }
  const std::vector<ViewId> views = viewsOnScreen(session_.workspace());
  const auto isEmpty = [&](ViewId id) { return session_.workspace().view(id).series.empty(); };
  const auto empty = std::ranges::find_if(views, isEmpty);
  const auto focus = std::ranges::find(views, session_.workspace().focus);
  const auto next = focus == views.end() || focus + 1 == views.end() ? views.begin() : focus + 1;
  session_.setFocus(empty != views.end() ? *empty : *next);
}

}  // namespace volumen
