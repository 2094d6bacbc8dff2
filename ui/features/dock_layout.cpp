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
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

FoldTitle* titleOf(const Workbench::Dock& dock) {
  return static_cast<FoldTitle*>(dock.widget->titleBarWidget());
}

// Height in pixels of a dock with its title, tabs and the window's bars. `lines` counts text lines.
struct DockHeight {
  int fixed, lines;
  int at(int line) const { return fixed + lines * line; }
};
constexpr DockHeight curveHeight{255, 8}, segmentsHeight{273, 14};
constexpr int lowestCurve = 230;

// Docks stacked as tabs, in order.
using Tabs = std::vector<Workbench::Dock>;

bool isBelow(const Workbench::Dock& dock) { return dock.place.order >= Workbench::firstBelow; }

// Qt places docks behind the front tab outside the window.
bool isInFront(const Workbench::Dock& dock) {
  return dock.widget->isVisible() && dock.widget->geometry().right() >= 0;
}

// Returns the version of saved layouts. Those with other panels have another one and are not restored.
int layoutVersion(const Workbench& bench) {
  QByteArray names;
  for (const auto& [name, dock] : bench.docks) names += name.toUtf8() + ' ';
  return qChecksum(names);
}

// Returns the settings key for the front panels of a kind of view.
QString frontKey(Workbench::About kind) {
  return kind == Workbench::About::flat ? QStringLiteral("window/front/flat")
                                        : QStringLiteral("window/front/scene");
}

// Arranges the panels, maximises views, and keeps the layout for the next start.
class DockLayout : public Feature {
 public:
  explicit DockLayout(Workbench& bench);

  void keep() override;
  bool eventFilter(QObject* window, QEvent* event) override;

 private:
  void makeActions();
  void followMaximised();
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
  QAction *maximise_, *leaveMaximised_, *fullScreen_, *resetLayout_;
  QByteArray before_;                              // layout before all docks were hidden, else empty
  std::optional<Workbench::About> kind_;           // kind of the view in focus
  std::map<Workbench::About, QStringList> front_;  // names of front panels by kind of view
  bool isKept_ = false;                            // true if an earlier start left a layout
};

DockLayout::DockLayout(Workbench& bench) : Feature(bench), window_(bench.window) {
  makeActions();
  menu_ = bench_.addMenu("panelsMenu", tr("Panels"), {{"viewMenu", 60, 140}});
  connect(&bench_, &Workbench::made, this, [this] {
    fillMenu();
    restore();
  });
  connect(&grid_, &ViewGrid::maximiseRequested, maximise_, &QAction::trigger);
  connect(&grid_, &ViewGrid::aloneChanged, this, &DockLayout::followMaximised);
  whenChanged(
      session_, this,
      [this] {
        showStates();
        followFocus();
      },
      showsOther);
  window_.installEventFilter(this);
}

void DockLayout::makeActions() {
  const auto maximise = [this](bool alone) { grid_.setAlone(session_.workspace().focus, alone); };
  const std::vector<Workbench::ActionEntry> table{
      {"maximise", tr("Maximise view"), {tr("F10")}, "", true, {}, {{"viewMenu", 60, 10}}},
      {"leaveMaximised", tr("Leave maximised view"), {tr("Esc")}, "", false, maximise},
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
  QList<QAction*> made;
  for (const Workbench::ActionEntry& entry : table) made << bench_.addAction(entry);
  maximise_ = made[0], leaveMaximised_ = made[1], fullScreen_ = made[2], resetLayout_ = made[3];
  leaveMaximised_->setEnabled(false);
  // Follows the views, so only a click triggers it.
  connect(maximise_, &QAction::triggered, this, maximise);
}

// Hides all docks while a view is maximised in the main window.
void DockLayout::followMaximised() {
  const bool isMaximised = grid_.isAlone(sceneViewId);
  if (isMaximised && before_.isEmpty()) {
    before_ = window_.saveState();
    for (const auto& [name, dock] : bench_.docks) dock.widget->hide();
  } else if (!isMaximised && !before_.isEmpty()) {
    for (const auto& [name, dock] : bench_.docks) dock.widget->show();
    window_.restoreState(std::exchange(before_, {}));
  }
  showStates();
  followFocus();
}

// Updates the actions for the window in focus.
void DockLayout::showStates() {
  const bool isMaximised = grid_.isAlone(session_.workspace().focus);
  maximise_->setChecked(isMaximised);
  leaveMaximised_->setEnabled(isMaximised);
  fullScreen_->setChecked(windowInFocus().isFullScreen());
}

void DockLayout::fillMenu() {
  for (const auto& [name, dock] : bench_.docks) menu_->addAction(dock.widget->toggleViewAction());
  menu_->addSeparator();
  menu_->addAction(resetLayout_);
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

// Raises in each stack of tabs the panel last in front for this kind, else the first one about it. A panel
// about both kinds stays in front.
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
    QDockWidget*& first = isBelow(dock) ? below : above;
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
  // Keeps the picture the largest part even in a small window. In a large one panels need no
  // more than this.
  const int width = window_.width(), height = window_.height();
  const int right = std::clamp(width / 4, 240, 380);
  const int fitting = window_.findChild<StudiesPanel*>()->fittingWidth();
  const int studies =
      std::min(std::max(std::clamp(width * 16 / 100, 150, 260), fitting), std::max(150, (width - 400) / 4));
  // In a low window the curve scrolls, so that segment list and page stay visible together.
  const int line = window_.fontMetrics().height();
  const int wholeCurve = std::max(height * 2 / 5, curveHeight.at(line));
  const int curve = std::min(wholeCurve, std::max(height - segmentsHeight.at(line), lowestCurve));
  const Tabs onRight = docksAt(Qt::RightDockWidgetArea);
  const auto below = std::ranges::find_if(onRight, isBelow);
  window_.resizeDocks({docksAt(Qt::LeftDockWidgetArea).front().widget, onRight.front().widget},
                      {studies, right}, Qt::Horizontal);
  window_.resizeDocks({onRight.front().widget, below->widget}, {curve, height - curve}, Qt::Vertical);
}

void DockLayout::restore() {
  const QSettings settings;
  const QRect screen = QApplication::primaryScreen()->availableGeometry();
  reset();
  // Without this the window would be too tall, as docks stood under each other while they were made.
  window_.layout()->activate();
  window_.resize(std::min(1440, screen.width()), std::min(900, screen.height()));
  const bool isPlaced =
      window_.restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
  if (isPlaced) putOnScreen(window_);
  isKept_ = window_.restoreState(settings.value(QStringLiteral("window/layout")).toByteArray(),
                                 layoutVersion(bench_));
  const QStringList folded = settings.value(QStringLiteral("window/folded")).toStringList();
  if (!isKept_) return;
  for (const auto& [name, dock] : bench_.docks) titleOf(dock)->setFolded(folded.contains(name));
  for (const auto kind : {Workbench::About::scene, Workbench::About::flat})
    front_[kind] = settings.value(frontKey(kind)).toStringList();
}

void DockLayout::keep() {
  grid_.setAlone(sceneViewId, false);
  QSettings settings;
  settings.setValue(QStringLiteral("window/geometry"), window_.saveGeometry());
  settings.setValue(QStringLiteral("window/layout"), window_.saveState(layoutVersion(bench_)));
  QStringList folded;
  for (const auto& [name, dock] : bench_.docks)
    if (titleOf(dock)->folded()) folded << name;
  settings.setValue(QStringLiteral("window/folded"), folded);
  rememberFront();
  for (const auto& [kind, names] : front_) settings.setValue(frontKey(kind), names);
}

// Lays out the docks at the first show if no layout was kept, as the window's size is unknown before.
bool DockLayout::eventFilter(QObject* window, QEvent* event) {
  if (event->type() == QEvent::Show && !std::exchange(isKept_, true)) {
    shareRoom();
    window_.layout()->activate();  // at once, before other pending layouts
  }
  return Feature::eventFilter(window, event);
}

}  // namespace

std::unique_ptr<Feature> makeDockLayout(Workbench& bench) { return std::make_unique<DockLayout>(bench); }

}  // namespace volumen
