#include <QInputDialog>
#include <QMenu>
#include <algorithm>
#include <set>

#include "results/series/series_facts.h"
#include "results/text/text.h"
#include "ui/features/facing_views.h"
#include "ui/features/feature.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/listed_entries.h"
#include "ui/workspace/edit_workspace.h"
#include "ui/workspace/own_protocols.h"
#include "ui/workspace/patients.h"

namespace volumen {

namespace {

// Hangs studies by the protocols that fit them, by menu and keys. Hangs mammograms and pairs of X-ray
// pictures when they are opened. Saves the views on screen as a protocol.
class HangingProtocols : public Feature {
 public:
  explicit HangingProtocols(Workbench& bench);

 private:
  void makeActions();
  void fillMenu();
  std::optional<PatientStudies> studies() const;
  std::vector<const HangingProtocol*> offered() const;
  std::string currentStudy() const;
  void forgetLast();
  void step(int by);
  void hang(const HangingProtocol& protocol);
  void await(const std::shared_ptr<const Study>& study, const OpenIntent& intent);
  void hangAwaited();
  bool mayHang(const Series& opened) const;
  void forgetClosed();
  void askName();
  void save(const QString& text);
  void tellProblems();

  QMenu* menu_;
  ListedEntries listed_;  // the fitting protocols
  KnownProtocols known_ = knownProtocols();
  std::string last_;                                   // name of the last protocol used
  std::string lastStudy_;                              // UID of the study it was used for
  std::set<std::string> hungByItself_;                 // UIDs of open studies hung automatically
  std::vector<std::shared_ptr<const Study>> awaited_;  // opened studies to be hung once shown
  std::shared_ptr<bool> openedTogether_;               // OpenIntent::isShown of the last opened study
  FacingViews facing_;
  std::optional<Layout> gridByItself_;  // layout of the last automatic hanging
};

HangingProtocols::HangingProtocols(Workbench& bench)
    : Feature(bench),
      menu_(bench.addMenu("protocolMenu", tr("Hanging protocols"), {{"viewMenu", 60, 52}})),
      facing_(session_, grid_, bench.document.frames, this) {
  makeActions();
  connect(menu_, &QMenu::aboutToShow, this, &HangingProtocols::fillMenu);
  const Loader* loader = &bench_.document.loader;
  for (const auto opened : {&Loader::studyOpened, &Loader::filesOpened})
    connect(loader, opened, this,
            [this](const QString&, const std::shared_ptr<const Study>& study, const OpenIntent& intent) {
              await(study, intent);
            });
  // Waits until the study is on screen.
  connect(&session_, &Session::workspaceChanged, this, [this] {
    if (!awaited_.empty())
      QMetaObject::invokeMethod(this, &HangingProtocols::hangAwaited, Qt::QueuedConnection);
  });
  connect(loader, &Loader::notLoaded, this, [this](const SeriesKey& key) {
    std::erase_if(awaited_, [&](const auto& study) {
      return std::ranges::any_of(study->volumes, [&](const Series& s) { return keyOf(s) == key; });
    });
  });
  connect(&open_, &OpenStudies::changed, this, &HangingProtocols::forgetClosed);
  tellProblems();
}

void HangingProtocols::makeActions() {
  bench_.addAction({"nextProtocol",
                    tr("Next protocol"),
                    {tr("Alt+PgDown")},
                    "",
                    false,
                    [this](bool) { step(1); },
                    {{"protocolMenu", 20}}});
  bench_.addAction({"previousProtocol",
                    tr("Previous protocol"),
                    {tr("Alt+PgUp")},
                    "",
                    false,
                    [this](bool) { step(-1); },
                    {{"protocolMenu", 20}}});
  bench_.addAction({"saveProtocol",
                    tr("Save these views as a protocol..."),
                    {},
                    "",
                    false,
                    [this](bool) { askName(); },
                    {{"protocolMenu", 30}}});
}

// Returns the studies of the patient in focus, or of the first series on screen. Empty if nothing is shown.
std::optional<PatientStudies> HangingProtocols::studies() const {
  const Workspace& workspace = session_.workspace();
  const Series* series = seriesIn(workspace, workspace.focus);
  for (const ViewId id : viewsOnScreen(workspace))
    if (!series) series = seriesIn(workspace, id);
  if (!series) return {};
  return studiesAround(open_.pictures(), *series);
}

std::vector<const HangingProtocol*> HangingProtocols::offered() const {
  std::vector<const HangingProtocol*> all;
  if (const auto around = studies())
    for (const std::size_t n : fitting(known_.protocols, *around)) all.push_back(&known_.protocols[n]);
  return all;
}

// Returns the UID of the current study.
std::string HangingProtocols::currentStudy() const {
  const auto around = studies();
  return around && !around->current.empty() ? around->current.front()->studyUid : std::string();
}

// Restarts the cycle of protocols if the study has changed.
void HangingProtocols::forgetLast() {
  if (currentStudy() != lastStudy_) last_.clear();
}

void HangingProtocols::fillMenu() {
  forgetLast();
  QList<QAction*> entries;
  const std::vector<const HangingProtocol*> all = offered();
  for (std::size_t n = 0; n < all.size(); ++n) {
    QString name = shownText(all[n]->name);
    auto* action = new QAction(name.replace(QLatin1Char('&'), QStringLiteral("&&")), menu_);
    action->setObjectName(QStringLiteral("protocol%1").arg(n));
    action->setCheckable(true);
    action->setChecked(all[n]->name == last_);
    connect(action, &QAction::triggered, this, [this, protocol = *all[n]] { hang(protocol); });
    entries << action;
  }
  if (entries.isEmpty()) {
    entries << new QAction(tr("None fits what is open"), menu_);
    entries.front()->setEnabled(false);
  }
  listed_.show(*menu_, entries);
}

void HangingProtocols::step(int by) {
  const std::vector<const HangingProtocol*> all = offered();
  if (all.empty()) return warn(tr("No hanging protocol fits what is open."));
  forgetLast();
  const int count = int(all.size());
  const auto isLast = [&](const HangingProtocol* p) { return p->name == last_; };
  const auto last = std::ranges::find_if(all, isLast);
  const int from = last != all.end() ? int(last - all.begin()) : by > 0 ? -1 : count;
  const int next = (from + by + count) % count;
  hang(*all[std::size_t(next)]);
  tell(tr("%1 (protocol %2 of %3)").arg(shownText(all[std::size_t(next)]->name)).arg(next + 1).arg(count));
}

void HangingProtocols::hang(const HangingProtocol& protocol) {
  const auto around = studies();
  if (!around) return;
  last_ = protocol.name;
  lastStudy_ = currentStudy();
  gridByItself_.reset();
  session_.endGesture();
  facing_.forget();
  session_.setFocus(mainFocusOf(session_.workspace()));
  grid_.setAlone(sceneViewId, false);
  session_.change(tr("Hang as %1").arg(shownText(protocol.name)),
                  hung(session_.workspace(), protocol, *around), hungKey);
  session_.endGesture();
  facing_.begin(protocol);
}

// Schedules automatic hanging of a study that was opened as a whole for the first time. Of several studies
// opened together only one is hung.
void HangingProtocols::await(const std::shared_ptr<const Study>& study, const OpenIntent& intent) {
  if (intent.scene || !intent.seriesUid.empty()) return;
  if (intent.how == OpenHow::beside || intent.how == OpenHow::lookedInto) return;
  if (intent.isShown && (!*intent.isShown || intent.isShown == openedTogether_)) return;
  openedTogether_ = intent.isShown;
  awaited_.push_back(study);
  QMetaObject::invokeMethod(this, &HangingProtocols::hangAwaited, Qt::QueuedConnection);
}

void HangingProtocols::hangAwaited() {
  const Workspace& workspace = session_.workspace();
  const Series* shown = seriesIn(workspace, workspace.focus);
  if (!shown || shown->studyUid.empty()) return;
  const auto isOfIt = [&](const SeriesIdentity& s) { return s.studyUid == shown->studyUid; };
  const auto isShown = [&](const std::shared_ptr<const Study>& study) {
    return std::ranges::any_of(study->volumes, isOfIt) || std::ranges::any_of(study->images, isOfIt);
  };
  if (std::erase_if(awaited_, isShown) == 0 || !mayHang(*shown)) return;
  if (!hungByItself_.insert(shown->studyUid).second) return;
  for (const HangingProtocol* protocol : offered())
    if (protocol->automatic) {
      hang(HangingProtocol(*protocol));
      gridByItself_ = session_.workspace().layout;
      return;
    }
}

// Returns false if the layout was chosen for this patient or the study was opened in the second window.
bool HangingProtocols::mayHang(const Series& opened) const {
  const Workspace& workspace = session_.workspace();
  if (isInSecond(workspace.focus)) return false;
  if (!comparesSeries(workspace.layout) || gridByItself_ == workspace.layout) return true;
  return std::ranges::any_of(patientsOnScreen(workspace),
                             [&](const Series* other) { return !areOfOnePatient(*other, opened); });
}

// Forgets closed studies, so that they are hung again when reopened.
void HangingProtocols::forgetClosed() {
  std::set<std::string> open;
  for (const Series* series : open_.pictures()) open.insert(series->studyUid);
  std::erase_if(hungByItself_, [&](const std::string& uid) { return !open.contains(uid); });
  const auto isOpen = [&](const SeriesIdentity& s) { return open.contains(s.studyUid); };
  std::erase_if(awaited_, [&](const std::shared_ptr<const Study>& study) {
    return std::ranges::none_of(study->volumes, isOpen) && std::ranges::none_of(study->images, isOpen);
  });
}

void HangingProtocols::askName() {
  if (!studies()) return warn(tr("Open a series first."));
  auto* dialog = new QInputDialog(bench_.dialogParent());
  dialog->setObjectName(QStringLiteral("protocolNameDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(tr("Save as hanging protocol"));
  dialog->setLabelText(tr("Name:"));
  connect(dialog, &QInputDialog::textValueSelected, this, &HangingProtocols::save);
  dialog->open();
}

void HangingProtocols::save(const QString& text) {
  const std::string name = shownText(text.toStdString()).trimmed().toStdString();
  if (name.empty()) return warn(tr("A hanging protocol needs a name."));
  forgetLast();
  const auto last = std::ranges::find(known_.protocols, last_, &HangingProtocol::name);
  const HangingProtocol made = protocolOf(session_.workspace(), name, open_.pictures(),
                                          last == known_.protocols.end() ? nullptr : &*last);
  if (const Status saved = saveOwnProtocol(made); !saved) return warnUntilDone(shownText(saved.message()));
  known_ = knownProtocols();
  last_ = name;
  lastStudy_ = currentStudy();
  tell(tr("Saved as hanging protocol %1").arg(shownText(name)));
}

void HangingProtocols::tellProblems() {
  QStringList problems;
  for (const std::string& problem : known_.problems) problems << shownText(problem);
  if (!problems.isEmpty()) warnUntilDone(tr("A hanging protocol of yours cannot be read."), problems);
}

}  // namespace

std::unique_ptr<Feature> makeHangingProtocols(Workbench& bench) {
  return std::make_unique<HangingProtocols>(bench);
}

}  // namespace volumen
