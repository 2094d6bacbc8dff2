// Guards that panels and actions take keys while the series of the views is not in memory: nothing is open,
// it is still being read, or it could not be read.
#include <QAbstractSpinBox>
#include <QCheckBox>
#include <QDockWidget>
#include <QMenu>
#include <QPointer>
#include <QUndoStack>

#include "tests/ui/journey.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A window that shows a ball which no file holds.
struct BallWindow : Journey {
  LoadedSeriesPtr ball = ballSeries();
  Mode mode = Mode::composite;

  Session& session() { return window.session(); }
  void show() {
    session().show(ball);
    session().setFocus(sceneViewId);
    session().edit(QStringLiteral("test"), [&](Scene& scene) { scene.mode = mode; });
  }
  // Returns all widgets of docks that take keys.
  std::vector<QPointer<QWidget>> takers() {
    std::vector<QPointer<QWidget>> all;
    for (const QDockWidget* dock : window.findChildren<QDockWidget*>())
      for (QWidget* widget : dock->findChildren<QWidget*>())
        if (widget->focusPolicy() & Qt::TabFocus) all.emplace_back(widget);
    return all;
  }
};

using TakeVolume = std::function<void(BallWindow&)>;

// A key that clicks some buttons would wait in their menus.
void pressKeys(const QPointer<QWidget>& widget) {
  for (const Qt::Key key : {Qt::Key_Right, Qt::Key_Up, Qt::Key_Delete, Qt::Key_Return, Qt::Key_Tab})
    if (widget) QTest::keyClick(widget, key);
  if (qobject_cast<QCheckBox*>(widget)) QTest::keyClick(widget, Qt::Key_Space);
}

}  // namespace

class TestWithoutVolume : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void panelsTakeKeys_data();
  void panelsTakeKeys();
  void actionsTakeKeys_data() { panelsTakeKeys_data(); }
  void actionsTakeKeys();
};

void TestWithoutVolume::panelsTakeKeys_data() {
  QTest::addColumn<int>("mode");
  QTest::addColumn<TakeVolume>("take");
  const auto row = [](const char* name, Mode mode, const TakeVolume& take) {
    QTest::newRow(name) << int(mode) << take;
  };
  const TakeVolume closed = [](BallWindow& w) { w.session().close({keyOf(w.ball->series)}); };
  const TakeVolume broughtBack = [closed](BallWindow& w) {
    closed(w);
    w.session().undoStack().undo();
  };
  const TakeVolume unreadable = [broughtBack](BallWindow& w) {
    broughtBack(w);
    QTRY_VERIFY_WITH_TIMEOUT(!w.window.document().loader.isBusy(), longest);
  };
  row("a projection that is closed", Mode::mip, closed);
  row("a projection brought back, and not read yet", Mode::mip, broughtBack);
  row("a projection that cannot be read", Mode::mip, unreadable);
  row("a curve brought back, and not read yet", Mode::composite, broughtBack);
}

// A number is half typed when the volume goes.
void TestWithoutVolume::panelsTakeKeys() {
  QFETCH(int, mode);
  QFETCH(TakeVolume, take);
  BallWindow w;
  w.mode = Mode(mode);
  w.show();
  const std::vector<QPointer<QWidget>> takers = w.takers();
  QVERIFY(takers.size() > 100);
  for (const QPointer<QWidget>& widget : takers) {
    w.show();
    if (!widget || !widget->isEnabled()) continue;
    widget->setFocus();
    if (qobject_cast<QAbstractSpinBox*>(widget)) QTest::keyClicks(widget, QStringLiteral("1"));
    take(w);
    QVERIFY(!w.session().series());
    pressKeys(widget);
  }
}

// Actions that open dialogs, end the program or go back in time have tests of their own.
void TestWithoutVolume::actionsTakeKeys() {
  QFETCH(int, mode);
  QFETCH(TakeVolume, take);
  BallWindow w;
  w.mode = Mode(mode);
  w.show();
  take(w);
  for (const QPointer<QAction> action : w.window.findChildren<QAction*>()) {
    if (!action || action->menu() || action->isSeparator() || !action->isEnabled()) continue;
    const QString text = action->text();
    const QStringList others{QStringLiteral("undo"), QStringLiteral("quit"), QStringLiteral("openSample")};
    if (text.endsWith(QStringLiteral("...")) || others.contains(action->objectName())) continue;
    action->trigger();
    QCoreApplication::processEvents();
  }
}

VOLUMEN_TEST(TestWithoutVolume);
#include "tst_without_volume.moc"
