#include <QInputDialog>
#include <QMenu>
#include <algorithm>

#include "results/text/text.h"
#include "ui/features/facing_views.h"
#include "ui/features/feature.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/listed_entries.h"
#include "ui/workspace/edit_workspace.h"
#include "ui/workspace/hanging_queue.h"
#include "ui/workspace/own_protocols.h"

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
  std::string lastName() const;
  void step(int by);
  void hang(const HangingProtocol& protocol, bool byItself = false);
  void await(const std::shared_ptr<const Study>& study, const OpenIntent& intent);
  void hangAwaited();
  void askName();
  void save(const QString& text);
  void tellProblems();

  QMenu* menu_;
  ListedEntries listed_;  // the fitting protocols
  KnownProtocols known_ = knownProtocols();
  HangingQueue queue_;
  FacingViews facing_;
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
    if (!queue_.awaited.empty())
      QMetaObject::invokeMethod(this, &HangingProtocols::hangAwaited, Qt::QueuedConnection);
  });
  connect(loader, &Loader::notLoaded, this,
          [this](const SeriesKey& key) { queue_ = withoutSeries(std::move(queue_), key); });
  connect(&open_, &OpenStudies::changed, this,
          [this] { queue_ = withoutClosed(std::move(queue_), open_.pictures()); });
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

// Returns the name of the protocol used last for the current study; empty if there is none.
std::string HangingProtocols::lastName() const { return lastNameFor(queue_.last, currentStudy()); }

void HangingProtocols::fillMenu() {
  QList<QAction*> entries;
  const std::vector<const HangingProtocol*> all = offered();
  const std::string last = lastName();
  for (std::size_t n = 0; n < all.size(); ++n) {
    QString name = shownText(all[n]->name);
    auto* action = new QAction(name.replace(QLatin1Char('&'), QStringLiteral("&&")), menu_);
    action->setObjectName(QStringLiteral("protocol%1").arg(n));
    action->setCheckable(true);
    action->setChecked(all[n]->name == last);
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
  const std::size_t next = indexFrom(all, lastName(), by);
  hang(*all[next]);
  tell(tr("%1 (protocol %2 of %3)").arg(shownText(all[next]->name)).arg(next + 1).arg(all.size()));
}

void HangingProtocols::hang(const HangingProtocol& protocol, bool byItself) {
  const auto around = studies();
  if (!around) return;
  queue_ = withHung(std::move(queue_), protocol, currentStudy(), byItself);
  session_.endGesture();
  facing_.forget();
  session_.setFocus(mainFocusOf(session_.workspace()));
  grid_.setAlone(sceneViewId, false);
  session_.change(tr("Hang as %1").arg(shownText(protocol.name)),
                  hung(session_.workspace(), protocol, *around), hungKey);
  session_.endGesture();
  facing_.begin(protocol);
}

// Schedules automatic hanging of a study that was opened as a whole.
void HangingProtocols::await(const std::shared_ptr<const Study>& study, const OpenIntent& intent) {
  if (intent.scene || !intent.seriesUid.empty()) return;
  if (intent.how != OpenHow::here && intent.how != OpenHow::instead) return;
  queue_ = withOpened(std::move(queue_), study, intent.isShown);
  QMetaObject::invokeMethod(this, &HangingProtocols::hangAwaited, Qt::QueuedConnection);
}

void HangingProtocols::hangAwaited() {
  const NextHanging next =
      nextHanging(std::move(queue_), session_.workspace(), open_.pictures(), known_.protocols);
  queue_ = next.queue;
  if (next.protocol) hang(*next.protocol, true);
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
  const auto last = std::ranges::find(known_.protocols, lastName(), &HangingProtocol::name);
  const HangingProtocol made = protocolOf(session_.workspace(), name, open_.pictures(),
                                          last == known_.protocols.end() ? nullptr : &*last);
  if (const Status saved = saveOwnProtocol(made); !saved) return warnUntilDone(shownText(saved.message()));
  known_ = knownProtocols();
  queue_.last = {name, currentStudy()};
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
