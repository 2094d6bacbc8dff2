#include <QApplication>
#include <QEvent>
#include <QMenuBar>
#include <QScreen>
#include <QSettings>
#include <QShortcut>
#include <algorithm>
#include <utility>

#include "ui/features/feature.h"
#include "ui/views/view_grid.h"
#include "ui/widgets/on_screen.h"
#include "ui/workspace/when_changed.h"

namespace volumen {

namespace {

// A window for a second screen. The workspace stores whether it is open, settings store its position.
class SecondWindowFeature : public Feature {
 public:
  explicit SecondWindowFeature(Workbench& bench);

  void keep() override;
  bool eventFilter(QObject* mainWindow, QEvent* event) override;

 private:
  void begin();
  void setOpen(bool open);
  void follow();
  void place();

  WindowBeside& window_;
  QAction* action_;
  bool isPlaced_ = false;
};

SecondWindowFeature::SecondWindowFeature(Workbench& bench)
    : Feature(bench),
      window_(grid_.secondWindow()),
      action_(bench_.addAction({"secondWindow",
                                tr("Second window"),
                                {tr("Ctrl+Shift+N")},
                                "",
                                true,
                                {},
                                {{"viewMenu", 60, 56}}})) {
  window_.setObjectName(QStringLiteral("secondWindow"));
  window_.setWindowTitle(tr("Second window of volumen"));
  window_.setAccessibleName(tr("Second window"));
  connect(action_, &QAction::triggered, this, &SecondWindowFeature::setOpen);
  connect(&window_, &WindowBeside::closed, this, [this] { setOpen(false); });
  connect(&bench_, &Workbench::made, this, &SecondWindowFeature::begin);
  whenChanged(session_, this, &SecondWindowFeature::follow,
              [](const Workspace& w) { return w.second.shown; });
  bench_.window.installEventFilter(this);
}

// Lets keys of the main window work here and open its menus. The keyboard focus moves to the main window for
// menus.
void SecondWindowFeature::begin() {
  window_.addActions(bench_.window.actions());
  for (const auto& [name, action] : bench_.actions) window_.addAction(action);
  QMenuBar* bar = bench_.window.menuBar();
  for (QAction* menu : bar->actions()) {
    auto* key = new QShortcut(QKeySequence::mnemonic(menu->text()), &window_);
    connect(key, &QShortcut::activated, this, [this, bar, menu] {
      bench_.window.activateWindow();
      bar->setActiveAction(menu);
    });
  }
  Workspace workspace = session_.workspace();
  workspace.second.shown = QSettings().value(QStringLiteral("secondWindow/open")).toBool();
  session_.adapt(workspace);
}

void SecondWindowFeature::setOpen(bool open) {
  session_.endGesture();
  session_.change(open ? tr("Open second window") : tr("Close second window"),
                  withSecondShown(session_.workspace(), open));
  session_.endGesture();
}

void SecondWindowFeature::follow() {
  const bool isOpen = session_.workspace().second.shown;
  action_->setChecked(isOpen);
  if (!bench_.window.isVisible() || isOpen == window_.isVisible()) return;
  if (isOpen) place();
  window_.setAttribute(Qt::WA_ShowWithoutActivating, !isInSecond(session_.workspace().focus));
  window_.setVisible(isOpen);
  grid_.takeKeys();
  grid_.viewShown()->activateWindow();
}

// Restores the last position if it is still on a screen. Otherwise maximises the window on another screen, or
// covers the right half of the only one.
void SecondWindowFeature::place() {
  if (std::exchange(isPlaced_, true)) return putOnScreen(window_);
  if (window_.restoreGeometry(QSettings().value(QStringLiteral("secondWindow/geometry")).toByteArray()))
    return putOnScreen(window_);
  const QScreen* own = bench_.window.screen();
  const QList<QScreen*> all = QApplication::screens();
  const auto other = std::ranges::find_if(all, [&](const QScreen* screen) { return screen != own; });
  const QRect room = (other == all.end() ? own : *other)->availableGeometry();
  window_.setGeometry(room.adjusted(room.width() / 2, 0, 0, 0));
  putOnScreen(window_);
  if (other != all.end()) window_.setWindowState(Qt::WindowMaximized);
}

// Closes with the main window.
void SecondWindowFeature::keep() {
  QSettings settings;
  settings.setValue(QStringLiteral("secondWindow/open"), session_.workspace().second.shown);
  if (isPlaced_) settings.setValue(QStringLiteral("secondWindow/geometry"), window_.saveGeometry());
  window_.hide();
}

bool SecondWindowFeature::eventFilter(QObject* mainWindow, QEvent* event) {
  if (event->type() == QEvent::Show)
    QMetaObject::invokeMethod(this, &SecondWindowFeature::follow, Qt::QueuedConnection);
  return Feature::eventFilter(mainWindow, event);
}

}  // namespace

std::unique_ptr<Feature> makeSecondWindow(Workbench& bench) {
  return std::make_unique<SecondWindowFeature>(bench);
}

}  // namespace volumen
