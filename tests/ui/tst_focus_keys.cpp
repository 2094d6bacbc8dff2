// Guards that everything is reached by keys: views by Tab, panels by F6, menus of views by the Menu key. The
// highlighted tools are those of the view in focus, and tool tips name keys.
#include <QDockWidget>
#include <QMenu>
#include <QToolBar>
#include <QToolButton>

#include "tests/ui/clean_settings.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/plain_text.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct Focus : MeasureWindow {
  Focus() { view()->setFocus(); }
  void press(Qt::Key key, Qt::KeyboardModifiers keys = {}) {
    QTest::keyClick(window.focusWidget(), key, keys);
  }
  bool hasKeys(ViewId id) { return window.focusWidget() == window.views()->viewOf(id); }
  ViewId inFocus() { return session().workspace().focus; }
  // Returns the dock that has the keyboard focus; empty if the views have it.
  QString part() {
    for (QDockWidget* dock : window.findChildren<QDockWidget*>())
      if (dock->isAncestorOf(window.focusWidget())) return dock->objectName();
    return window.views()->isAncestorOf(window.focusWidget()) ? QString() : QStringLiteral("the list");
  }
};

}  // namespace

class TestFocusKeys : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void tabGoesRoundTheViews_data();
  void tabGoesRoundTheViews();
  void tabLeavesAViewThatIsAlone();
  void keysActOnTheViewThatTabCameTo();
  void f6GoesThroughTheParts();
  void f6GoesBackToTheViewInFocus();
  void theMenuKeyOpensTheViewsMenu_data();
  void theMenuKeyOpensTheViewsMenu();
  void withoutASeriesThereIsNoMenu();
  void toolsOfTheViewInFocusAreLit_data();
  void toolsOfTheViewInFocusAreLit();
  void toolTipsNameKeys();
  void whatALetterChoseIsTold();
};

void TestFocusKeys::tabGoesRoundTheViews_data() {
  QTest::addColumn<QByteArray>("layout");
  QTest::addColumn<bool>("isBack");
  for (const char* layout : {"layoutPlanes", "layoutBesidePlanes", "layoutTwo", "layoutFour"}) {
    QTest::addRow("%s, Tab", layout) << QByteArray(layout) << false;
    QTest::addRow("%s, Shift+Tab", layout) << QByteArray(layout) << true;
  }
}

void TestFocusKeys::tabGoesRoundTheViews() {
  QFETCH(QByteArray, layout);
  QFETCH(bool, isBack);
  Focus w;
  w.child<QAction>(layout.constData())->trigger();
  QCoreApplication::processEvents();
  std::vector<ViewId> ids = viewsOnScreen(w.session().workspace());
  if (isBack) std::ranges::reverse(ids);
  w.session().setFocus(ids.front());
  w.window.views()->setFocus();
  QVERIFY(w.hasKeys(ids.front()));
  const int steps = w.session().undoStack().count();
  for (std::size_t n = 1; n <= ids.size(); ++n) {
    w.press(isBack ? Qt::Key_Backtab : Qt::Key_Tab, isBack ? Qt::ShiftModifier : Qt::NoModifier);
    const ViewId next = ids[n % ids.size()];
    QCOMPARE(w.inFocus(), next);
    QVERIFY(w.hasKeys(next));
  }
  QCOMPARE(w.session().undoStack().count(), steps);
}

void TestFocusKeys::tabLeavesAViewThatIsAlone() {
  Focus w;
  w.child<QAction>("layoutOne")->trigger();
  QCoreApplication::processEvents();
  const ViewId alone = w.inFocus();
  w.window.views()->setFocus();
  QVERIFY(w.hasKeys(alone));
  w.press(Qt::Key_Tab);
  QVERIFY(!w.hasKeys(alone));
  QCOMPARE(w.inFocus(), alone);
}

void TestFocusKeys::keysActOnTheViewThatTabCameTo() {
  Focus w;
  w.press(Qt::Key_Tab);
  const ViewId next = viewsOnScreen(w.session().workspace())[1];
  QCOMPARE(w.inFocus(), next);
  const SlicePlane before = *w.view(next)->plane();
  w.press(Qt::Key_Down);
  const glm::dvec3 moved = w.view(next)->plane()->centre - before.centre;
  QVERIFY(std::abs(std::abs(glm::dot(moved, before.normal())) - 1) < 1e-9);
}

void TestFocusKeys::f6GoesThroughTheParts() {
  Focus w;
  QStringList seen;
  do {
    w.press(Qt::Key_F6);
    seen << w.part();
  } while (!seen.last().isEmpty() && seen.size() < 30);
  QVERIFY2(seen.last().isEmpty(), "it comes around");
  QVERIFY(seen.contains(QStringLiteral("studiesDock")));
  QVERIFY(seen.contains(QStringLiteral("flatDock")));
  QCOMPARE(seen.removeDuplicates(), 0);
  QVERIFY(w.hasKeys(axialViewId));
  for (qsizetype n = seen.size() - 2; n >= 0; --n) {
    w.press(Qt::Key_F6, Qt::ShiftModifier);
    QCOMPARE(w.part(), seen[n]);
  }
  w.press(Qt::Key_F6, Qt::ShiftModifier);
  QVERIFY(w.hasKeys(axialViewId));
}

void TestFocusKeys::f6GoesBackToTheViewInFocus() {
  Focus w;
  w.session().setFocus(sagittalViewId);
  w.press(Qt::Key_F6);
  QVERIFY(!w.hasKeys(sagittalViewId));
  w.press(Qt::Key_F6, Qt::ShiftModifier);
  QVERIFY(w.hasKeys(sagittalViewId));
  QCOMPARE(w.inFocus(), sagittalViewId);
}

void TestFocusKeys::theMenuKeyOpensTheViewsMenu_data() {
  QTest::addColumn<int>("view");
  QTest::addColumn<int>("key");
  QTest::addColumn<int>("held");
  QTest::addColumn<QByteArray>("menu");
  for (const auto& [view, menu] :
       {std::pair(int(coronalViewId), "flatMenu"), {int(sceneViewId), "volumeMenu"}}) {
    QTest::addRow("Menu, %s", menu) << view << int(Qt::Key_Menu) << int(Qt::NoModifier) << QByteArray(menu);
    QTest::addRow("Shift+F10, %s", menu)
        << view << int(Qt::Key_F10) << int(Qt::ShiftModifier) << QByteArray(menu);
  }
}

void TestFocusKeys::theMenuKeyOpensTheViewsMenu() {
  QFETCH(int, view);
  QFETCH(int, key);
  QFETCH(int, held);
  QFETCH(QByteArray, menu);
  Focus w;
  w.session().setFocus(view);
  QVERIFY(w.hasKeys(view));
  w.press(Qt::Key(key), Qt::KeyboardModifiers(held));
  auto* open = w.child<QMenu>(menu.constData());
  QVERIFY(open && open->isVisible());
  QVERIFY2(!w.child<QAction>("maximise")->isChecked(), "that is F10");
  QTest::keyClick(open, Qt::Key_Down);
  QVERIFY2(open->activeAction(), "keys go on in it");
  open->close();
}

void TestFocusKeys::withoutASeriesThereIsNoMenu() {
  Focus w;
  w.session().show(nullptr);
  QTest::keyClick(w.view(), Qt::Key_Menu);
  QVERIFY(!w.child<QMenu>("flatMenu"));
}

void TestFocusKeys::toolsOfTheViewInFocusAreLit_data() {
  QTest::addColumn<int>("view");
  QTest::addColumn<QString>("lit");
  QTest::newRow("a slice") << int(axialViewId)
                           << QStringLiteral(
                                  "windowTool scrollTool panTool zoomTool crosshairTool magnifierTool");
  QTest::newRow("3D") << int(sceneViewId) << QStringLiteral("rotateTool curveTool scissorsTool");
}

void TestFocusKeys::toolsOfTheViewInFocusAreLit() {
  QFETCH(int, view);
  QFETCH(QString, lit);
  Focus w;
  w.session().setFocus(view == axialViewId ? sceneViewId : axialViewId);
  w.session().setFocus(view);
  QStringList enabled;
  for (const QAction* action : w.child<QToolBar>("tools")->actions())
    if (action->objectName().endsWith(QStringLiteral("Tool")) && action->isEnabled())
      enabled << action->objectName();
  enabled.sort();
  QStringList wanted = lit.split(QLatin1Char(' '));
  wanted.sort();
  QCOMPARE(enabled, wanted);
  QVERIFY2(w.child<QToolButton>("measureButton")->isEnabled(), "lengths and angles are of both");
  QVERIFY(w.child<QAction>("lengthTool")->isEnabled() && w.child<QAction>("angleTool")->isEnabled());
  QCOMPARE(w.child<QAction>("ellipseTool")->isEnabled(), view == axialViewId);
}

void TestFocusKeys::toolTipsNameKeys() {
  Focus w;
  int named = 0;
  for (const QAction* action : w.child<QToolBar>("tools")->actions())
    for (const QKeySequence& key : action->shortcuts()) {
      const QString text = key.toString(QKeySequence::NativeText);
      QVERIFY2(action->toolTip().contains(text), qPrintable(action->objectName() + action->toolTip()));
      ++named;
    }
  QVERIFY(named > 5);
  QCOMPARE(w.child<QAction>("lengthTool")->toolTip(), toolTipOf(QStringLiteral("Length (D)")));
  drag(w.view(), {60, 70}, {90, 70});  // names the step that undo would undo
  QVERIFY(w.child<QAction>("undo")->toolTip().contains(QStringLiteral("Ctrl+Z")));
}

// T chooses the arrow in a slice, and rotation in 3D.
void TestFocusKeys::whatALetterChoseIsTold() {
  Focus w;
  w.press(Qt::Key_T);
  QCOMPARE(w.child<QLabel>("toldText")->text(), QStringLiteral("Left button: Arrow"));
}

VOLUMEN_TEST(TestFocusKeys);
#include "tst_focus_keys.moc"
