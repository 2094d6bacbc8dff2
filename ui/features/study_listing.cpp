#include <QApplication>
#include <QLabel>
#include <QSplitter>
#include <QStackedWidget>
#include <algorithm>
#include <deque>

#include "results/series/series_facts.h"
#include "results/text/text.h"
#include "ui/features/feature.h"
#include "ui/panels/study_browser.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/path_dialog.h"
#include "ui/widgets/plain_text.h"
#include "ui/workspace/indexed_text.h"
#include "ui/workspace/patients.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

bool showsAnything(const Workspace& workspace) {
  return std::ranges::any_of(viewsOnScreen(workspace),
                             [&](ViewId id) { return !workspace.view(id).series.empty(); });
}

// Joins names, such as "Doe, Jane (1) and Roe, Rick (2)".
QString joined(const QStringList& names) {
  if (names.size() < 2) return names.join(QString());
  return QObject::tr("%1 and %2")
      .arg(names.mid(0, names.size() - 1).join(QStringLiteral(", ")), names.back());
}

QString patientsText(const std::vector<const Series*>& patients) {
  if (patients.size() < 2) return {};
  if (namesHidden()) return QObject::tr("The views show %1 different patients.").arg(patients.size());
  QStringList names;
  for (const Series* series : patients) names << patientText(*series);
  return QObject::tr("The views show different patients: %1.").arg(joined(names));
}

// Shows the study browser above the views, or in their place while nothing is open. A line at the top warns
// if views show different patients.
class StudyListing : public Feature {
 public:
  explicit StudyListing(Workbench& bench);

 private:
  void makePatientsBar();
  void makeActions();
  void connectBrowser();
  void connectSource(StudySource& source);
  void showBrowser(bool on);
  void arrangeBrowser();
  void showPatients();
  void askForImport();
  void showImport(const ImportReport& report);
  void showImported();
  void openFound(const QString& place, const std::vector<std::string>& files, const OpenIntent& intent);
  void showFound(const QString& place, const std::shared_ptr<const Study>& study, const OpenIntent& intent);
  void join(const QString& place, const std::shared_ptr<const Study>& study,
            const std::vector<std::string>& files);
  void showNext();
  void showChosen(const Study& study, const OpenIntent& intent);
  void showObject(const std::string& seriesUid);
  void closeOtherPatients(const Series& series);
  void leaveKeys();
  void giveWay();
  void comeBack();
  void focusNextView();

  StudySources& sources_ = bench_.document.sources;
  StudyBrowser* browser_;
  QAction* shown_;  // checked while the browser is shown
  QLabel* patients_;
  // A study opened while another series was loading.
  struct Waiting {
    QString place;
    std::shared_ptr<const Study> study;
    OpenIntent intent;
  };
  std::deque<Waiting> waiting_;
  bool listedOnce_ = false;                              // since the start of the program
  bool gaveWay_ = false;                                 // true while hidden for a load
  bool isArriving_ = false;                              // true while parts of a fetched series are shown
  std::map<QString, std::vector<std::string>> filesOf_;  // files of the open studies
};

StudyListing::StudyListing(Workbench& bench)
    : Feature(bench), browser_(new StudyBrowser(sources_)), patients_(plainLabel()) {
  browser_->hide();
  bench_.split.insertWidget(0, browser_);
  bench_.split.setStretchFactor(1, 1);
  makePatientsBar();
  makeActions();
  connectBrowser();
  for (const auto& source : sources_.all()) connectSource(*source);
  connect(&sources_, &StudySources::added, this,
          [this](std::size_t number) { connectSource(*sources_.all()[number]); });
  connect(&sources_, &StudySources::failed, this,
          [this](const QString& sentence) { warnUntilDone(sentence); });
  if (const Status offered = sources_.offerArchives(); !offered)
    bench_.banner.add(QString::fromStdString(offered.message()));
  connect(&sources_, &StudySources::offeredChanged, this, [this] {
    if (!showsAnything(session_.workspace()) && !browser_->isEmpty()) showBrowser(true);
  });
  const Loader* loader = &bench_.document.loader;
  connect(loader, &Loader::filesOpened, this, &StudyListing::showFound);
  connect(loader, &Loader::openBegan, this, &StudyListing::leaveKeys);
  connect(loader, &Loader::loadingChanged, this, [this] {
    if (bench_.document.loader.isLoading() && !showsAnything(session_.workspace())) giveWay();
  });
  // Queued, because another load may begin at once.
  for (const auto ended : {&Loader::idle, &Loader::loadingChanged})
    connect(loader, ended, this, &StudyListing::showNext, Qt::QueuedConnection);
  browser_->refresh();
}

void StudyListing::makePatientsBar() {
  patients_->setObjectName(QStringLiteral("patientsBar"));
  patients_->setWordWrap(true);
  patients_->setStyleSheet(
      QStringLiteral("#patientsBar { background: #4a1720; border-bottom: 2px solid #ff6b6b; color: #ffd9dc;"
                     " padding: 4px 12px; }"));
  patients_->hide();
  bench_.addAboveViews(patients_);
}

void StudyListing::makeActions() {
  shown_ = bench_.addAction({"showBrowser",
                             tr("Study list"),
                             {tr("Ctrl+B")},
                             "",
                             true,
                             {},
                             {{"fileMenu", 20}, {"toolBar", 10, 10}}});
  connect(shown_, &QAction::triggered, this, &StudyListing::showBrowser);
  const auto find = [this](bool) {
    showBrowser(true);
    browser_->startSearch();
  };
  bench_.addAction(
      {"findStudy", tr("Find study..."), {QKeySequence::Find}, "", false, find, {{"fileMenu", 20}}});
  bench_.addAction({"importFolder",
                    tr("Import folder..."),
                    {tr("Ctrl+I")},
                    "",
                    false,
                    [this](bool) { askForImport(); },
                    {{"fileMenu", 20}}});
}

void StudyListing::connectBrowser() {
  connect(browser_, &StudyBrowser::importRequested, this, &StudyListing::askForImport);
  connect(browser_, &StudyBrowser::hideRequested, this, [this] { showBrowser(false); });
  connect(browser_, &StudyBrowser::openRequested, this, [this](const IndexedChoice& choice, bool beside) {
    sources_.current().open(choice, beside ? OpenHow::beside : OpenHow::instead);
  });
  connect(browser_, &StudyBrowser::sendRequested, &bench_, &Workbench::sendRequested);
  connect(browser_, &StudyBrowser::offlineRequested, this, [this] {
    warn(
        tr("The files of this study are not there now: connect the disk or network folder that "
           "holds them, or import the folder from where they are."));
  });
  // Shows the browser at the start if its first list is not empty.
  connect(browser_, &StudyBrowser::listChanged, this, [this] {
    if (std::exchange(listedOnce_, true) || browser_->isEmpty()) return;
    if (!bench_.document.loader.isBusy() && !showsAnything(session_.workspace())) showBrowser(true);
  });
  connect(&grid_, &ViewGrid::aloneChanged, this, &StudyListing::arrangeBrowser);
  whenChanged(session_, this, &StudyListing::showPatients, showsOther, &Preferences::hideNames);
  whenChanged(
      session_, this, [this] { showBrowser(!showsAnything(session_.workspace()) && !browser_->isEmpty()); },
      showsAnything);
  whenChanged(session_, browser_, &StudyBrowser::showNames, &Preferences::hideNames);
  // Other programs may have changed the list meanwhile.
  connect(qApp, &QGuiApplication::applicationStateChanged, this, [this](Qt::ApplicationState state) {
    if (state == Qt::ApplicationActive && !sources_.current().isRemote()) browser_->refresh();
  });
}

void StudyListing::connectSource(StudySource& source) {
  connect(
      &source, &StudySource::filesFound, this,
      [this, &source](const IndexedChoice& choice, const std::vector<std::string>& files,
                      const OpenIntent& intent) { openFound(source.placeOf(choice.study), files, intent); });
  connect(&source, &StudySource::arriving, this, [this](const std::shared_ptr<const Series>& part) {
    isArriving_ = part != nullptr;
    if (isArriving_) giveWay();
    if (!isArriving_ && !bench_.document.loader.isBusy()) comeBack();
  });
  connect(&source, &StudySource::failed, this, [this](const QString& sentence) { warnUntilDone(sentence); });
  connect(&source, &StudySource::notOpened, this,
          [this](const IndexedChoice&, const QString& sentence) { warnUntilDone(sentence); });
  connect(&source, &StudySource::noticed, this,
          [this](const QString& sentence) { bench_.banner.add(sentence); });
  connect(&source, &StudySource::importBegun, this, [this] {
    if (!showsAnything(session_.workspace())) showBrowser(true);
  });
  connect(&source, &StudySource::importEnded, this, &StudyListing::showImport);
}

void StudyListing::showBrowser(bool on) {
  shown_->setChecked(on);
  if (!on && isInSecond(session_.workspace().focus)) grid_.takeKeys();
  arrangeBrowser();
  if (!on) return;
  browser_->refresh();
  browser_->setFocus();
  if (grid_.secondWindow().isActiveWindow()) bench_.window.activateWindow();
}

void StudyListing::arrangeBrowser() {
  const bool isShown = shown_->isChecked() && !grid_.isAlone(sceneViewId);
  const bool any = showsAnything(session_.workspace());
  const bool wereBoth = browser_->isVisibleTo(&bench_.split) && bench_.pages.isVisibleTo(&bench_.split);
  browser_->setVisible(isShown);
  bench_.pages.setVisible(any || !isShown);
  if (isShown && any && !wereBoth)
    bench_.split.setSizes({bench_.split.height() * 11 / 20, bench_.split.height() * 9 / 20});
}

void StudyListing::showPatients() {
  const QString text = patientsText(patientsOnScreen(session_.workspace()));
  patients_->setText(text);
  patients_->setVisible(!text.isEmpty());
}

void StudyListing::askForImport() {
  StudySource* importer = sources_.importer();
  if (!importer) return;
  const auto* dialog = openPathDialog(
      bench_.dialogParent(),
      {"importFolderDialog", tr("Import a folder into the list of studies"), {}, {}, QFileDialog::Directory});
  connect(dialog, &QFileDialog::fileSelected, importer,
          [importer](const QString& path) { importer->import({path}); });
}

void StudyListing::showImport(const ImportReport& report) {
  tell(importText(report));
  if (report.files > 0 && !report.cancelled) showImported();
  std::vector<Refused> lost = report.refused;
  lost.insert(lost.end(), report.lacking.begin(), report.lacking.end());
  if (lost.empty()) return;
  warnUntilDone(lost.size() == 1 ? tr("1 file could not be imported.")
                                 : tr("%1 files could not be imported.").arg(lost.size()),
                refusedTexts(lost));
}

// Leaves the keyboard focus where it is while pictures are shown.
void StudyListing::showImported() {
  if (!showsAnything(session_.workspace())) return showBrowser(true);
  shown_->setChecked(true);
  arrangeBrowser();
}

// Shows a study that is already open without reading it again, unless a feature wants to look into its files.
void StudyListing::openFound(const QString& place, const std::vector<std::string>& files,
                             const OpenIntent& intent) {
  const std::shared_ptr<const Study> open = open_.studyOf(place);
  const auto known = filesOf_.find(place);
  const bool isRead = open && known != filesOf_.end() && known->second == files;
  OpenIntent found = intent;
  found.files = files;
  if (isRead && intent.how != OpenHow::lookedInto) return showFound(place, open, found);
  bench_.document.loader.openFiles(place, found);
}

void StudyListing::showFound(const QString& place, const std::shared_ptr<const Study>& study,
                             const OpenIntent& intent) {
  if (intent.how == OpenHow::lookedInto) return void(filesOf_.erase(place));  // it may be listed elsewhere
  if (intent.how == OpenHow::joining) return join(place, study, intent.files);
  filesOf_[place] = intent.files;
  bench_.document.opener.list(place, study);
  if (!study->refused.empty()) bench_.banner.add(unreadText(*study), refusedTexts(study->refused));
  waiting_.push_back({place, study, intent});
  showNext();
}

// Leaves the views as they are.
void StudyListing::join(const QString& place, const std::shared_ptr<const Study>& study,
                        const std::vector<std::string>& files) {
  const std::shared_ptr<const Study> before = open_.studyOf(place);
  if (!before || before == study) return;
  filesOf_[place] = files;
  bench_.document.opener.join(place, study);
  for (Waiting& waiting : waiting_)
    if (waiting.study == before) waiting.study = study;
  if (study->refused.size() > before->refused.size())
    bench_.banner.add(unreadText(*study), refusedTexts(study->refused));
}

// Shows waiting studies one by one, as the next request would replace the one before. Skips studies closed
// meanwhile. The study list comes back if nothing is shown.
void StudyListing::showNext() {
  while (!waiting_.empty() && !bench_.document.loader.isLoading()) {
    const Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    if (open_.studyOf(next.place) == next.study) showChosen(*next.study, next.intent);
  }
  comeBack();
}

// Shows the chosen or first series in place of other patients, beside the others, or in the view in focus.
void StudyListing::showChosen(const Study& study, const OpenIntent& intent) {
  const auto first = [&] { return bench_.document.opener.firstOf(study, intent.seriesUid); };
  const std::optional<Series> series = first();
  if (!series) return showObject(intent.seriesUid);
  if (intent.how == OpenHow::beside) focusNextView();
  if (intent.how == OpenHow::instead) closeOtherPatients(*series);
  bench_.document.opener.show(*first());  // chosen anew, as another view may be in focus
  if (intent.how == OpenHow::instead) browser_->clearSearch();
  if (intent.how == OpenHow::instead || !showsAnything(session_.workspace())) giveWay();
}

void StudyListing::showObject(const std::string& seriesUid) {
  for (const DerivedObjectPtr& object : open_.derived())
    if (!seriesUid.empty() && object->seriesUid == seriesUid) return bench_.objectChosen(object);
  bench_.banner.add(tr("There is nothing to show in this study."));
}

void StudyListing::closeOtherPatients(const Series& series) {
  const auto isOther = [&](const Series* other) { return !areOfOnePatient(*other, series); };
  const std::vector<const Series*> patients = patientsOnScreen(session_.workspace());
  if (std::ranges::none_of(patients, isOther)) return;
  session_.setFocus(mainFocusOf(session_.workspace()));
  session_.makeRoom(
      tr("Close %1").arg(patientText(*patients.front())),
      bench_.document.opener.inLayoutOf(withoutOtherPatients(session_.workspace(), series), series));
}

// Moves the keyboard focus from the search field, as keys are meant for the study being opened.
void StudyListing::leaveKeys() {
  const QWidget* keys = bench_.window.focusWidget();
  if (!keys || !browser_->isAncestorOf(keys)) return;
  gaveWay_ = !showsAnything(session_.workspace());
  if (gaveWay_)
    bench_.window.setFocus();
  else
    grid_.takeKeys();
}

// Hides the browser for the shown series or the first image of the one being loaded.
void StudyListing::giveWay() {
  const bool any = showsAnything(session_.workspace());
  if (!any && !bench_.document.loader.isLoading() && !isArriving_) return;
  gaveWay_ = !any;
  showBrowser(false);
  if (!any) bench_.window.setFocus();
}

// Shows the browser again if the load failed.
void StudyListing::comeBack() {
  if (bench_.document.loader.isLoading() || isArriving_ || !std::exchange(gaveWay_, false)) return;
  if (!showsAnything(session_.workspace())) showBrowser(true);
}

// Moves the focus to the next view to compare: the first empty one, else the one after the focus.
void StudyListing::focusNextView() {
  const Workspace& workspace = session_.workspace();
  if (!showsAnything(workspace)) return;
  if (!comparesSeries(layoutOf(workspace, workspace.focus))) {
    session_.endGesture();
    session_.change(tr("Layout"), withLayout(workspace, Layout::two));
  }
  const std::vector<ViewId> views = viewsBeside(session_.workspace(), session_.workspace().focus);
  const auto isEmpty = [&](ViewId id) { return session_.workspace().view(id).series.empty(); };
  const auto empty = std::ranges::find_if(views, isEmpty);
  const auto focus = std::ranges::find(views, session_.workspace().focus);
  const auto next = focus == views.end() || focus + 1 == views.end() ? views.begin() : focus + 1;
  session_.setFocus(empty != views.end() ? *empty : *next);
}

}  // namespace

std::unique_ptr<Feature> makeStudyListing(Workbench& bench) { return std::make_unique<StudyListing>(bench); }

}  // namespace volumen
