#include <QApplication>
#include <QDockWidget>
#include <QLayout>
#include <QMenu>
#include <QScreen>
#include <QSettings>
#include <QStatusBar>
#include <QStyle>
#include <QToolBar>
#include <algorithm>

#include "ui/features/feature.h"
#include "ui/panels/studies_panel.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/fold_title.h"
#include "ui/widgets/on_screen.h"

namespace volumen {

namespace {

constexpr int layoutVersion = 4;  // a layout kept under another one knows other panels: not restored

FoldTitle* titleOf(const Workbench::Dock& dock) {
  return static_cast<FoldTitle*>(dock.widget->titleBarWidget());
}

// Where the panels stand, over the whole window or not, and what of it is kept for the next start.
class DockLayout : public Feature {
 public:
  explicit DockLayout(Workbench& bench);

  void keep() override;
  bool eventFilter(QObject* window, QEvent* event) override;

 private:
  void makeActions();
  void setMaximised(bool alone);
  void fillMenu();
  std::vector<QDockWidget*> docksAt(Qt::DockWidgetArea area) const;
  void reset();
  void shareRoom();
  void restore();

  QMainWindow& window_;
  QMenu* menu_;
  QByteArray before_;    // while the view is alone
  bool isKept_ = false;  // from an earlier start
};

DockLayout::DockLayout(Workbench& bench) : Feature(bench), window_(bench.window) {
  makeActions();
  menu_ = bench_.addMenu("panelsMenu", tr("Panels"), {{"viewMenu", 60, 140}});
  connect(&bench_, &Workbench::made, this, [this] {
    fillMenu();
    restore();
  });
  connect(&grid_, &ViewGrid::maximiseRequested, bench_.action("maximise"), &QAction::toggle);
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
       [this](bool on) { window_.setWindowState(window_.windowState().setFlag(Qt::WindowFullScreen, on)); },
       {{"viewMenu", 60, 20}}},
      {"resetLayout", tr("Reset layout"), {}, "", false, [this](bool) { reset(); }}};
  for (const Workbench::ActionEntry& entry : table) bench_.addAction(entry);
  bench_.action("leaveMaximised")->setEnabled(false);
}

void DockLayout::setMaximised(bool alone) {
  if (alone) before_ = window_.saveState();
  grid_.setAlone(alone);
  for (const auto& [name, dock] : bench_.docks) dock.widget->setVisible(!alone);
  for (QToolBar* bar : window_.findChildren<QToolBar*>()) bar->setVisible(!alone);
  window_.statusBar()->setVisible(!alone);
  if (!alone) window_.restoreState(before_);
  bench_.action("leaveMaximised")->setEnabled(alone);
}

void DockLayout::fillMenu() {
  for (const auto& [name, dock] : bench_.docks) menu_->addAction(dock.widget->toggleViewAction());
  menu_->addSeparator();
  menu_->addAction(bench_.action("resetLayout"));
}

std::vector<QDockWidget*> DockLayout::docksAt(Qt::DockWidgetArea area) const {
  std::vector<Workbench::Dock> found;
  for (const auto& [name, dock] : bench_.docks)
    if (dock.place.area == area) found.push_back(dock);
  std::ranges::sort(found, {}, [](const Workbench::Dock& dock) { return dock.place.order; });
  std::vector<QDockWidget*> docks;
  for (const Workbench::Dock& dock : found) docks.push_back(dock.widget);
  return docks;
}

void DockLayout::reset() {
  for (const auto& [name, dock] : bench_.docks) {
    dock.widget->setFloating(false);
    titleOf(dock)->setFolded(false);
  }
  for (QDockWidget* dock : docksAt(Qt::LeftDockWidgetArea))
    window_.addDockWidget(Qt::LeftDockWidgetArea, dock);
  const std::vector<QDockWidget*> right = docksAt(Qt::RightDockWidgetArea);
  window_.addDockWidget(Qt::RightDockWidgetArea, right[0]);
  window_.splitDockWidget(right[0], right[1], Qt::Vertical);
  for (std::size_t n = 2; n < right.size(); ++n) window_.tabifyDockWidget(right[1], right[n]);
  for (const auto& [name, dock] : bench_.docks) dock.widget->setVisible(dock.place.isOpen);
  right[1]->raise();
  shareRoom();
}

void DockLayout::shareRoom() {
  // The picture is the largest thing in a small window too; in a large one panels need no more than this.
  const int width = window_.width(), height = window_.height();
  const int right = std::clamp(width / 4, 240, 380);
  const int fitting = window_.findChild<StudiesPanel*>()->fittingWidth();
  const int studies =
      std::min(std::max(std::clamp(width * 16 / 100, 150, 260), fitting), std::max(150, (width - 400) / 4));
  const int curve = std::max(height * 2 / 5, 330);
  QDockWidget *list = bench_.dock("studies"), *transfer = bench_.dock("transfer");
  window_.resizeDocks({list, transfer}, {studies, right}, Qt::Horizontal);
  window_.resizeDocks({transfer, bench_.dock("lights")}, {curve, height - curve}, Qt::Vertical);
}

void DockLayout::restore() {
  const QSettings settings;
  const QRect screen = QApplication::primaryScreen()->availableGeometry();
  window_.resize(std::min(1440, screen.width()), std::min(900, screen.height()));
  reset();
  const bool isPlaced =
      window_.restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
  QList<QRect> screens;
  const int title = window_.style()->pixelMetric(QStyle::PM_TitleBarHeight);
  for (const QScreen* each : QApplication::screens())
    screens << each->availableGeometry().adjusted(0, title, 0, 0);
  // It may have been kept on another screen.
  if (isPlaced && !window_.isMaximized() && !window_.isFullScreen())
    window_.setGeometry(onScreen(window_.geometry(), screens));
  isKept_ =
      window_.restoreState(settings.value(QStringLiteral("window/layout")).toByteArray(), layoutVersion);
  const QStringList folded = settings.value(QStringLiteral("window/folded")).toStringList();
  if (isKept_)
    for (const auto& [name, dock] : bench_.docks) titleOf(dock)->setFolded(folded.contains(name));
}

void DockLayout::keep() {
  bench_.action("maximise")->setChecked(false);
  QSettings settings;
  settings.setValue(QStringLiteral("window/geometry"), window_.saveGeometry());
  settings.setValue(QStringLiteral("window/layout"), window_.saveState(layoutVersion));
  QStringList folded;
  for (const auto& [name, dock] : bench_.docks)
    if (titleOf(dock)->folded()) folded << name;
  settings.setValue(QStringLiteral("window/folded"), folded);
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
