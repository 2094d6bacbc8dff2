#include <QApplication>
#include <QDockWidget>
#include <QLayout>
#include <QMenu>
#include <QScreen>
#include <QSettings>
#include <algorithm>
#include <map>
#include <optional>

#include "ui/features/feature.h"
#include "ui/panels/studies_panel.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/fold_title.h"
#include "ui/widgets/on_screen.h"

namespace volumen {

namespace {

constexpr int layoutVersion = 5;  // a layout kept under another one knows other panels: not restored

FoldTitle* titleOf(const Workbench::Dock& dock) {
  return static_cast<FoldTitle*>(dock.widget->titleBarWidget());
}

// Pixels that a dock needs with its title, its tabs and the bars of the window, by the height of a line of
// text.
struct DockHeight {
  int fixed, lines;
  int at(int line) const { return fixed + lines * line; }
};
constexpr DockHeight curveHeight{255, 8}, segmentsHeight{273, 14};
constexpr int lowestCurve = 230;

// Tabs of one another, by their order.
using Tabs = std::vector<Workbench::Dock>;

// Tabs behind the one in front lie outside the window.
bool isInFront(const Workbench::Dock& dock) {
  return dock.widget->isVisible() && dock.widget->geometry().right() >= 0;
}

// Where the front of a kind of view is kept.
QString frontKey(Workbench::About kind) {
  return kind == Workbench::About::flat ? QStringLiteral("window/front/flat")
                                        : QStringLiteral("window/front/scene");
}

// Where the panels stand, which are in front, over the whole window or not, and what of it is kept for the
// next start.
class DockLayout : public Feature {
 public:
  explicit DockLayout(Workbench& bench);

  void keep() override;
  bool eventFilter(QObject* window, QEvent* event) override;

 private:
  void makeActions();
  void setMaximised(bool alone);
  void setDocksHidden(bool hidden);
  QWidget& windowInFocus() const { return *grid_.viewShown()->window(); }
  void showStates();
  void fillMenu();
  Tabs docksAt(Qt::DockWidgetArea area) const;
  std::vector<Tabs> tabsSeen() const;
  void followFocus();
  void rememberFront();
  void bringForward();
  void reset();
  void shareRoom();
  void restore();

  QMainWindow& window_;
  QMenu* menu_;
  QByteArray before_;                              // while the view is alone
  std::optional<Workbench::About> kind_;           // of the view in focus
  std::map<Workbench::About, QStringList> front_;  // panels that were in front with such a view in focus
  bool isKept_ = false;                            // from an earlier start
};

DockLayout::DockLayout(Workbench& bench) : Feature(bench), window_(bench.window) {
  makeActions();
  menu_ = bench_.addMenu("panelsMenu", tr("Panels"), {{"viewMenu", 60, 140}});
  connect(&bench_, &Workbench::made, this, [this] {
    fillMenu();
    restore();
  });
  connect(&grid_, &ViewGrid::maximiseRequested, bench_.action("maximise"), &QAction::toggle);
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            if (!showsOther(before, after)) return;
            showStates();
            followFocus();
          });
  window_.installEventFilter(this);
}

void DockLayout::makeActions() {
  const std::vector<Workbench::ActionEntry> table{
      {"maximise",
       tr("Maximise view"),
       {tr("F10")},
       "",
       true,
       [this](bool on) { setMaximised(on); },
       {{"viewMenu", 60, 10}}},
      {"leaveMaximised",
       tr("Leave maximised view"),
       {tr("Esc")},
       "",
       false,
       [this](bool) { bench_.action("maximise")->setChecked(false); }},
      {"fullScreen",
       tr("Full screen"),
       {tr("F11")},
       "",
       true,
       [this](bool on) {
         QWidget& window = windowInFocus();
         window.setWindowState(window.windowState().setFlag(Qt::WindowFullScreen, on));
       },
       {{"viewMenu", 60, 20}}},
      {"resetLayout", tr("Reset layout"), {}, "", false, [this](bool) { reset(); }}};
  for (const Workbench::ActionEntry& entry : table) bench_.addAction(entry);
  bench_.action("leaveMaximised")->setEnabled(false);
}

// In its own window. That of the panels is all for it, but for tools and the status line.
void DockLayout::setMaximised(bool alone) {
  const ViewId focus = session_.workspace().focus;
  bench_.action("leaveMaximised")->setEnabled(alone);
  if (grid_.isAlone(focus) == alone) return;  // the focus went to the other window
  if (alone && !isInSecond(focus)) before_ = window_.saveState();
  grid_.setAlone(focus, alone);
  if (!isInSecond(focus)) setDocksHidden(alone);
  followFocus();
}

void DockLayout::setDocksHidden(bool hidden) {
  for (const auto& [name, dock] : bench_.docks) dock.widget->setVisible(!hidden);
  if (!hidden) window_.restoreState(before_);
}

// What the actions say of the window in focus.
void DockLayout::showStates() {
  bench_.action("maximise")->setChecked(grid_.isAlone(session_.workspace().focus));
  bench_.action("fullScreen")->setChecked(windowInFocus().isFullScreen());
}

void DockLayout::fillMenu() {
  for (const auto& [name, dock] : bench_.docks) menu_->addAction(dock.widget->toggleViewAction());
  menu_->addSeparator();
  menu_->addAction(bench_.action("resetLayout"));
}

Tabs DockLayout::docksAt(Qt::DockWidgetArea area) const {
  Tabs found;
  for (const auto& [name, dock] : bench_.docks)
    if (dock.place.area == area) found.push_back(dock);
  std::ranges::sort(found, {}, [](const Workbench::Dock& dock) { return dock.place.order; });
  return found;
}

std::vector<Tabs> DockLayout::tabsSeen() const {
  std::vector<Tabs> all;
  for (const Workbench::Dock& dock : docksAt(Qt::RightDockWidgetArea)) {
    if (!dock.widget->isVisible()) continue;
    const QList<QDockWidget*> beside = window_.tabifiedDockWidgets(dock.widget);
    const auto isAmong = [&](const Tabs& tabs) { return beside.contains(tabs.front().widget); };
    const auto found = std::ranges::find_if(all, isAmong);
    if (found == all.end())
      all.push_back({dock});
    else
      found->push_back(dock);
  }
  return all;
}

void DockLayout::followFocus() {
  const Workspace& workspace = session_.workspace();
  const ViewState& view = workspace.view(workspace.focus);
  if (view.series.empty() || !window_.isVisible() || grid_.isAlone(sceneViewId)) return;
  const bool isScene = showsScene(view.kind) && !showsFrames(workspace, workspace.focus);
  const auto now = isScene ? Workbench::About::scene : Workbench::About::flat;
  if (kind_ == now) return;
  rememberFront();
  kind_ = now;
  bringForward();
}

void DockLayout::rememberFront() {
  if (!kind_ || !window_.isVisible()) return;
  QStringList& names = front_[*kind_];
  names.clear();
  for (const Tabs& tabs : tabsSeen())
    for (const Workbench::Dock& dock : tabs)
      if (isInFront(dock)) names << dock.widget->objectName();
}

// Of each place what was in front with this kind in focus, else the first that is about it. A panel that is
// about both stays: whoever chose it works on in the other view.
void DockLayout::bringForward() {
  for (const Tabs& tabs : tabsSeen()) {
    const auto front = std::ranges::find_if(tabs, isInFront);
    if (front == tabs.end() || front->place.about == Workbench::About::any) continue;
    const auto wasInFront = [&](const Workbench::Dock& dock) {
      return front_[*kind_].contains(dock.widget->objectName());
    };
    const auto suits = [&](const Workbench::Dock& dock) { return dock.place.about == *kind_; };
    auto chosen = std::ranges::find_if(tabs, wasInFront);
    if (chosen == tabs.end() && !suits(*front)) chosen = std::ranges::find_if(tabs, suits);
    if (chosen != tabs.end() && chosen != front) chosen->widget->raise();
  }
}

void DockLayout::reset() {
  for (const auto& [name, dock] : bench_.docks) {
    dock.widget->setFloating(false);
    titleOf(dock)->setFolded(false);
  }
  for (const Workbench::Dock& dock : docksAt(Qt::LeftDockWidgetArea))
    window_.addDockWidget(Qt::LeftDockWidgetArea, dock.widget);
  QDockWidget *above = nullptr, *below = nullptr;
  for (const Workbench::Dock& dock : docksAt(Qt::RightDockWidgetArea)) {
    QDockWidget*& first = dock.place.order < Workbench::firstBelow ? above : below;
    if (first)
      window_.tabifyDockWidget(first, dock.widget);
    else
      window_.addDockWidget(Qt::RightDockWidgetArea, first = dock.widget, Qt::Vertical);
  }
  for (const auto& [name, dock] : bench_.docks) dock.widget->setVisible(dock.place.isOpen);
  front_.clear();
  for (QDockWidget* first : {above, below}) first->raise();
  if (kind_) bringForward();
  shareRoom();
}

void DockLayout::shareRoom() {
  // The picture is the largest thing in a small window too; in a large one panels need no more than this.
  const int width = window_.width(), height = window_.height();
  const int right = std::clamp(width / 4, 240, 380);
  const int fitting = window_.findChild<StudiesPanel*>()->fittingWidth();
  const int studies =
      std::min(std::max(std::clamp(width * 16 / 100, 150, 260), fitting), std::max(150, (width - 400) / 4));
  // In a low window the curve scrolls rather than the segments: their list and the page below are seen
  // together.
  const int line = window_.fontMetrics().height();
  const int wholeCurve = std::max(height * 2 / 5, curveHeight.at(line));
  const int curve = std::min(wholeCurve, std::max(height - segmentsHeight.at(line), lowestCurve));
  QDockWidget *list = bench_.dock("studies"), *transfer = bench_.dock("transfer");
  window_.resizeDocks({list, transfer}, {studies, right}, Qt::Horizontal);
  window_.resizeDocks({transfer, bench_.dock("lights")}, {curve, height - curve}, Qt::Vertical);
}

void DockLayout::restore() {
  const QSettings settings;
  const QRect screen = QApplication::primaryScreen()->availableGeometry();
  reset();
  // As docks stood under each other while they were made, the window would be too tall for any screen.
  window_.layout()->activate();
  window_.resize(std::min(1440, screen.width()), std::min(900, screen.height()));
  const bool isPlaced =
      window_.restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
  if (isPlaced) putOnScreen(window_);
  isKept_ =
      window_.restoreState(settings.value(QStringLiteral("window/layout")).toByteArray(), layoutVersion);
  const QStringList folded = settings.value(QStringLiteral("window/folded")).toStringList();
  if (!isKept_) return;
  for (const auto& [name, dock] : bench_.docks) titleOf(dock)->setFolded(folded.contains(name));
  for (const auto kind : {Workbench::About::scene, Workbench::About::flat})
    front_[kind] = settings.value(frontKey(kind)).toStringList();
}

void DockLayout::keep() {
  if (grid_.isAlone(sceneViewId)) {
    grid_.setAlone(sceneViewId, false);
    setDocksHidden(false);
  }
  QSettings settings;
  settings.setValue(QStringLiteral("window/geometry"), window_.saveGeometry());
  settings.setValue(QStringLiteral("window/layout"), window_.saveState(layoutVersion));
  QStringList folded;
  for (const auto& [name, dock] : bench_.docks)
    if (titleOf(dock)->folded()) folded << name;
  settings.setValue(QStringLiteral("window/folded"), folded);
  rememberFront();
  for (const auto& [kind, names] : front_) settings.setValue(frontKey(kind), names);
}

// Where nothing was kept: only when the window is shown is its size known.
bool DockLayout::eventFilter(QObject* window, QEvent* event) {
  if (event->type() == QEvent::Show && !std::exchange(isKept_, true)) {
    shareRoom();
    window_.layout()->activate();  // at once, whatever else waits to be laid out
  }
  return Feature::eventFilter(window, event);
}

}  // namespace

std::unique_ptr<Feature> makeDockLayout(Workbench& bench) { return std::make_unique<DockLayout>(bench); }

}  // namespace volumen
