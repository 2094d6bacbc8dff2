#include <QApplication>
#include <QDockWidget>
#include <QFileInfo>
#include <QKeyEvent>
#include <QLayout>
#include <QScreen>
#include <QSettings>
#include <QStatusBar>
#include <QStyle>
#include <QToolBar>

#include "ui/main_window.h"
#include "ui/panels/snapshot_panel.h"
#include "ui/panels/studies_panel.h"
#include "ui/panels/study_browser.h"
#include "ui/preferences_dialog.h"
#include "ui/views/latin_key.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/fold_title.h"
#include "ui/widgets/on_screen.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

constexpr int layoutVersion = 4;  // a layout kept under another one knows other panels: not restored

FoldTitle* titleOf(const QDockWidget* dock) { return static_cast<FoldTitle*>(dock->titleBarWidget()); }

}  // namespace

void MainWindow::resetLayout() {
  const auto dock = [this](const char* name) { return bench_->docks.at(QLatin1String(name)); };
  for (const auto& [name, each] : bench_->docks) {
    each->setFloating(false);
    titleOf(each)->setFolded(false);
  }
  addDockWidget(Qt::LeftDockWidgetArea, dock("studies"));
  addDockWidget(Qt::RightDockWidgetArea, dock("transfer"));
  splitDockWidget(dock("transfer"), dock("lights"), Qt::Vertical);
  for (const char* name : {"clip", "segment", "snapshot", "measurements", "keyImages", "regions", "camera",
                           "effects", "accuracy"})
    tabifyDockWidget(dock("lights"), dock(name));
  for (const auto& [name, each] : bench_->docks)
    each->setVisible(name != QStringLiteral("camera") && name != QStringLiteral("effects") &&
                     name != QStringLiteral("accuracy") && name != QStringLiteral("keyImages") &&
                     name != QStringLiteral("regions"));
  dock("lights")->raise();
  shareRoom();
}

void MainWindow::shareRoom() {
  // The picture is the largest thing in a small window too; in a large one panels need no more than this.
  const int right = std::clamp(width() / 4, 240, 380);
  const int studies = std::min(std::max(std::clamp(width() * 16 / 100, 150, 260), studies_->fittingWidth()),
                               std::max(150, (width() - 400) / 4));
  const int curve = std::max(height() * 2 / 5, 330);
  QDockWidget *list = bench_->docks.at(QStringLiteral("studies")),
              *transfer = bench_->docks.at(QStringLiteral("transfer"));
  resizeDocks({list, transfer}, {studies, right}, Qt::Horizontal);
  resizeDocks({transfer, bench_->docks.at(QStringLiteral("lights"))}, {curve, height() - curve},
              Qt::Vertical);
}

void MainWindow::restoreLayout() {
  const QSettings settings;
  const QRect screen = QApplication::primaryScreen()->availableGeometry();
  resize(std::min(1440, screen.width()), std::min(900, screen.height()));
  resetLayout();
  const bool isKept = restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
  QList<QRect> screens;
  const int title = style()->pixelMetric(QStyle::PM_TitleBarHeight);
  for (const QScreen* each : QApplication::screens())
    screens << each->availableGeometry().adjusted(0, title, 0, 0);
  // It may have been kept on another screen.
  if (isKept && !isMaximized() && !isFullScreen()) setGeometry(onScreen(geometry(), screens));
  layoutKept_ = restoreState(settings.value(QStringLiteral("window/layout")).toByteArray(), layoutVersion);
  const QStringList folded = settings.value(QStringLiteral("window/folded")).toStringList();
  if (layoutKept_)
    for (const auto& [name, dock] : bench_->docks) titleOf(dock)->setFolded(folded.contains(name));
}

void MainWindow::keepLayout() {
  document_.opener.keepLayouts();
  QSettings settings;
  settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
  settings.setValue(QStringLiteral("window/layout"), saveState(layoutVersion));
  QStringList folded;
  for (const auto& [name, dock] : bench_->docks)
    if (titleOf(dock)->folded()) folded << name;
  settings.setValue(QStringLiteral("window/folded"), folded);
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  // Only now its size is known.
  if (std::exchange(layoutKept_, true)) return;
  shareRoom();
  layout()->activate();  // at once, whatever else waits to be laid out
}

void MainWindow::setMaximised(bool alone) {
  if (alone) layoutBefore_ = saveState();
  grid_->setAlone(alone);
  for (const auto& [name, dock] : bench_->docks) dock->setVisible(!alone);
  for (QToolBar* bar : findChildren<QToolBar*>()) bar->setVisible(!alone);
  statusBar()->setVisible(!alone);
  if (!alone) restoreState(layoutBefore_);
  bench_->action("leaveMaximised")->setEnabled(alone);
}

void MainWindow::applyPreferences(const Preferences& before, const Preferences& after) {
  storePreferences(after);
  if (before.theme != after.theme || before.textPercent != after.textPercent) showTheme();
  bench_->action("lightTheme")->setChecked(after.theme == Theme::light);
  bench_->action("hideNames")->setChecked(after.hideNames);
  if (before.hideNames == after.hideNames) return;
  studies_->showNames();
  showPage();  // it marks what is shown
  banner_->refresh();
}

void MainWindow::showTheme() {
  applyTheme(*qApp, session_.preferences().theme, session_.preferences().textPercent);
  for (const auto& [name, action] : bench_->actions) {
    const QString iconName = action->property("iconName").toString();
    if (!iconName.isEmpty()) action->setIcon(icon(iconName));
  }
}

void MainWindow::showPreferences() {
  auto* dialog = findChild<PreferencesDialog*>();
  if (!dialog) {
    dialog = new PreferencesDialog(session_, this);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
  }
  dialog->show();
  dialog->activateWindow();
}

// The action whose key lies where a letter of another script was pressed: Qt itself finds those that a
// second, Latin layout of the keyboard has. True: there is one.
bool MainWindow::triggerByPlace(const QKeyEvent& event) {
  const int key = latinKey(event);
  if (key == event.key()) return false;
  const QKeySequence wanted(QKeyCombination(event.modifiers(), Qt::Key(key)));
  for (QAction* action : actions())
    if (action->isEnabled() && action->shortcuts().contains(wanted)) {
      action->trigger();
      return true;
    }
  return false;
}

// The keypad's keys as they come with and without NumLock. Under X11 no shortcut can tell them from the keys
// of the other blocks, and with NumLock on none fires at all.
void MainWindow::keyPressEvent(QKeyEvent* event) {
  static const std::map<int, std::pair<const char*, const char*>> views{
      {Qt::Key_1, {"viewAnterior", "viewPosterior"}}, {Qt::Key_End, {"viewAnterior", "viewPosterior"}},
      {Qt::Key_3, {"viewLeft", "viewRight"}},         {Qt::Key_PageDown, {"viewLeft", "viewRight"}},
      {Qt::Key_7, {"viewSuperior", "viewInferior"}},  {Qt::Key_Home, {"viewSuperior", "viewInferior"}},
      {Qt::Key_0, {"resetView", "resetView"}},        {Qt::Key_Insert, {"resetView", "resetView"}}};
  const auto view = views.find(event->key());
  const bool typing = focusWidget() && focusWidget()->testAttribute(Qt::WA_InputMethodEnabled);
  if (!typing && triggerByPlace(*event)) return;
  if (view == views.end() || typing || !(event->modifiers() & Qt::KeypadModifier))
    return QMainWindow::keyPressEvent(event);
  const bool opposite = event->modifiers() & Qt::ControlModifier;
  bench_->action(opposite ? view->second.second : view->second.first)->trigger();
}

}  // namespace volumen
