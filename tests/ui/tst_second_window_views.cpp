// Guards the views of the second window. They scroll with those of the main window, and the same keys, tools,
// panels and menus act on them, whichever window is active. Its grid and maximised view are separate, and
// keys pass through both windows. Real events.
#include <QCheckBox>
#include <QClipboard>
#include <QDockWidget>
#include <QMenu>
#include <QToolButton>
#include <QWindow>

#include "tests/ui/clean_settings.h"
#include "tests/ui/hand.h"
#include "tests/ui/second_window.h"
#include "tests/unit/suite.h"
#include "ui/tools/tool.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

QImage copiedAllViews(QWidget* with) {
  QApplication::clipboard()->clear();
  QTest::keyClick(with, Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
  return QApplication::clipboard()->image().convertToFormat(QImage::Format_RGB32);
}

}  // namespace

class TestSecondWindowViews : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void eitherWindowScrollsTheOther();
  void keysActOnItsViews();
  void panelsActOnItsViewFromTheMainWindow();
  void menusActOnItsViewFromTheMainWindow();
  void keysFollowTheFrameWhateverWindowIsActive();
  void keysOpenTheMenusOfTheMainWindow();
  void whatIsMeasuredInItIsUndoneInIt();
  void itsGridIsChosenWhileItHasTheFocus();
  void layoutsOfOneGroupAreOfTheMainWindow();
  void emptyViewsSayWhatToDo();
  void aViewIsEnlargedWithinItsWindow();
  void tabAndF6GoThroughBothWindows();
  void allViewsAreThoseOfTheWindowInFocus();
  void aScreenOfOtherPixelsIsFollowed();
};

void TestSecondWindowViews::eitherWindowScrollsTheOther() {
  Beside w;
  QVERIFY(w.isOpen);
  QCOMPARE(w.z(besideFirst), w.z(axialViewId));
  const double before = w.z(besideFirst);
  wheel(w.view(besideFirst), -3);
  w.session().endGesture();
  QVERIFY(std::abs(w.z(besideFirst) - before) > 0.5);
  QCOMPARE(w.z(axialViewId), w.z(besideFirst));
  wheel(w.view(axialViewId), 5);
  w.session().endGesture();
  QVERIFY(w.z(axialViewId) != before);
  QCOMPARE(w.z(besideFirst), w.z(axialViewId));
  QTRY_VERIFY_WITH_TIMEOUT(!w.view(besideFirst)->picture().isNull(), longest);
}

void TestSecondWindowViews::keysActOnItsViews() {
  Beside w;
  QVERIFY(w.isOpen);
  const double before = w.z(besideFirst);
  w.press(Qt::Key_Down);
  QVERIFY(w.z(besideFirst) != before);
  for (const auto& [key, tool] :
       {std::pair(Qt::Key_M, "pan"), {Qt::Key_B, "scroll"}, {Qt::Key_D, "length"}}) {
    w.press(key);
    QCOMPARE(QByteArray(w.views().tool().name), QByteArray(tool));
  }
  w.press(Qt::Key_Menu);
  auto* menu = w.beside().findChild<QMenu*>(QStringLiteral("flatMenu"));
  QVERIFY(menu && menu->isVisible());
  menu->close();
}

// A press in the main window activates that first.
void TestSecondWindowViews::panelsActOnItsViewFromTheMainWindow() {
  Beside w;
  QVERIFY(w.isOpen);
  QVERIFY(w.activate(w.window));
  QCOMPARE(w.workspace().focus, besideFirst);
  auto* inverted = w.child<QCheckBox>("flatInverted");
  QTRY_VERIFY_WITH_TIMEOUT(inverted->isVisible() && inverted->isEnabled(), longest);
  QTest::mouseClick(inverted, Qt::LeftButton, {}, QPoint(8, inverted->height() / 2));
  QVERIFY(w.isInverted(besideFirst) && !w.isInverted(axialViewId));
  QCOMPARE(w.workspace().focus, besideFirst);
  QVERIFY(w.click(axialViewId));
  QVERIFY(w.activate(w.beside()));
  QVERIFY(w.activate(w.window));
  QVERIFY(!inverted->isChecked());
  QTest::mouseClick(inverted, Qt::LeftButton, {}, QPoint(8, inverted->height() / 2));
  QVERIFY2(w.isInverted(axialViewId), "that was clicked last");
}

void TestSecondWindowViews::menusActOnItsViewFromTheMainWindow() {
  Beside w;
  QVERIFY(w.isOpen);
  QVERIFY(w.activate(w.window));
  Hand(w.window).menu({"viewMenu", "kindMenu"}, "show3D");
  QVERIFY(w.workspace().view(besideFirst).kind == ViewKind::volume && w.isSeen(besideFirst));
  QVERIFY(w.views().viewOf(besideFirst)->window() == &w.beside());
  QCOMPARE(w.window.view(), w.views().volumeView(besideFirst));
  QVERIFY2(w.workspace().view(axialViewId).kind == ViewKind::axial, "that of the main window");
}

void TestSecondWindowViews::keysFollowTheFrameWhateverWindowIsActive() {
  Beside w;
  QVERIFY(w.isOpen);
  const auto press = [](const QWidget& in, Qt::Key key) { QTest::keyClick(in.focusWidget(), key); };
  QVERIFY(w.activate(w.window));
  QCOMPARE(w.window.focusWidget(), w.view(axialViewId));
  press(w.window, Qt::Key_I);
  QVERIFY(w.isInverted(besideFirst) && !w.isInverted(axialViewId));
  press(w.window, Qt::Key_M);
  QCOMPARE(QByteArray(w.views().tool().name), QByteArray("pan"));
  QCOMPARE(w.workspace().focus, besideFirst);
  press(w.window, Qt::Key_Tab);
  QCOMPARE(w.workspace().focus, axialViewId);
  press(w.window, Qt::Key_I);
  QVERIFY(w.isInverted(axialViewId) && w.isInverted(besideFirst));
  QVERIFY(w.activate(w.beside()));
  QCOMPARE(w.workspace().focus, axialViewId);
  press(w.beside(), Qt::Key_I);
  QVERIFY(!w.isInverted(axialViewId) && w.isInverted(besideFirst));
  press(w.beside(), Qt::Key_Tab);
  QCOMPARE(w.workspace().focus, besideFirst);
  press(w.beside(), Qt::Key_I);
  QVERIFY(!w.isInverted(besideFirst));
}

void TestSecondWindowViews::keysOpenTheMenusOfTheMainWindow() {
  Beside w;
  QVERIFY(w.isOpen);
  auto* menu = w.child<QMenu>("fileMenu");
  w.press(Qt::Key_F, Qt::AltModifier);
  QTRY_VERIFY_WITH_TIMEOUT(menu->isVisible(), longest);
  menu->close();
  QCOMPARE(w.workspace().focus, besideFirst);
}

void TestSecondWindowViews::whatIsMeasuredInItIsUndoneInIt() {
  Beside w;
  QVERIFY(w.isOpen);
  const Workspace before = w.workspace();
  w.press(Qt::Key_D);
  const QPointF middle = w.view(besideFirst)->rect().center();
  drag(w.view(besideFirst), middle - QPointF(30, 0), middle + QPointF(30, 20));
  QCOMPARE(w.all().size(), std::size_t(1));
  QVERIFY(w.last().series == keyOf(w.series->series));
  w.press(Qt::Key_Z, Qt::ControlModifier);
  QVERIFY(w.all().empty());
  QVERIFY(w.workspace() == before);
}

void TestSecondWindowViews::itsGridIsChosenWhileItHasTheFocus() {
  Beside w;
  QVERIFY(w.isOpen);
  const Workspace before = w.workspace();
  w.press(Qt::Key_6, Qt::AltModifier);
  auto* menu = w.child<QMenu>("layoutMenu");
  auto* cell = w.child<QToolButton>("grid2x3");
  QTRY_VERIFY_WITH_TIMEOUT(menu->isVisible() && cell->isVisible(), longest);
  QTest::mouseClick(cell, Qt::LeftButton);
  QVERIFY(w.workspace().second.layout == (Layout{Layout::Kind::grid, 2, 3}));
  QVERIFY2(w.workspace().layout == Layout::planes, "that of the main window");
  for (ViewId id = besideFirst; id < besideFirst + 6; ++id) {
    QVERIFY(w.isSeen(id) && w.views().viewOf(id)->window() == &w.beside());
    QVERIFY(w.beside().rect().contains(w.views().viewOf(id)->geometry()));
    for (ViewId other = besideFirst; other < id; ++other)
      QVERIFY(!w.views().viewOf(id)->geometry().intersects(w.views().viewOf(other)->geometry()));
  }
  for (const ViewId id : viewsInMain(w.workspace())) QVERIFY(w.isSeen(id));
  w.undo();
  QVERIFY(w.workspace() == before);
  QVERIFY(w.isSeen(besideFirst) && !w.isSeen(besideSecond));
}

void TestSecondWindowViews::layoutsOfOneGroupAreOfTheMainWindow() {
  Beside w;
  QVERIFY(w.isOpen);
  for (const char* name : {"layoutPlanes", "layoutBesidePlanes"})
    QVERIFY(!w.child<QAction>(name)->isEnabled());
  QVERIFY2(w.child<QAction>("layoutOne")->isChecked(), "there is one view");
  w.press(Qt::Key_5, Qt::AltModifier);
  QVERIFY(w.workspace().second.layout == Layout::four && w.isSeen(besideFirst + 3));
  QVERIFY(w.child<QAction>("layoutFour")->isChecked() && w.workspace().layout == Layout::planes);
  w.press(Qt::Key_1, Qt::AltModifier);
  QVERIFY(!w.isSeen(besideSecond));
  QVERIFY(w.click(axialViewId));
  QVERIFY(w.child<QAction>("layoutPlanes")->isEnabled() && w.child<QAction>("layoutPlanes")->isChecked());
  w.child<QAction>("layoutOne")->trigger();
  QVERIFY(w.workspace().layout == Layout::one && w.isSeen(axialViewId));
  QVERIFY(w.click(besideFirst));
  QVERIFY2(w.isSeen(axialViewId) && !w.isSeen(sceneViewId), "the main window shows the view it showed");
}

void TestSecondWindowViews::emptyViewsSayWhatToDo() {
  Beside w;
  QVERIFY(w.isOpen);
  w.child<QAction>("layoutTwo")->trigger();
  const auto isBlank = [](const QImage& picture) {
    for (int y = 4; y < picture.height() - 4; ++y)
      for (int x = 4; x < picture.width() - 4; ++x)
        if (qGreen(picture.pixel(x, y)) > 100) return false;
    return true;
  };
  QVERIFY(!isBlank(w.views().viewOf(besideSecond)->grab().toImage()));
  QVERIFY(isBlank(w.views().viewOf(besideSecond)->capture()));
}

void TestSecondWindowViews::aViewIsEnlargedWithinItsWindow() {
  Beside w;
  QVERIFY(w.isOpen);
  w.child<QAction>("layoutTwo")->trigger();
  QVERIFY(w.isSeen(besideSecond));
  QAction* maximise = w.child<QAction>("maximise");
  auto* list = w.child<QDockWidget>("studiesDock");
  QTest::mouseDClick(w.view(besideFirst), Qt::LeftButton, {}, {5, 5});
  QVERIFY(maximise->isChecked() && !w.isSeen(besideSecond));
  QCOMPARE(w.view(besideFirst)->geometry(), w.beside().rect());
  QVERIFY2(list->isVisible() && w.isSeen(coronalViewId), "the main window stays as it is");
  QVERIFY(w.click(axialViewId));
  QVERIFY2(!maximise->isChecked() && !w.isSeen(besideSecond), "that is the main window's");
  QTest::keyClick(w.window.focusWidget(), Qt::Key_F10);
  QVERIFY(!list->isVisible() && !w.isSeen(coronalViewId) && w.isSeen(axialViewId));
  QVERIFY(w.click(besideFirst));
  QVERIFY(maximise->isChecked());
  w.press(Qt::Key_Escape);
  QVERIFY(w.isSeen(besideSecond) && !maximise->isChecked());
  QVERIFY2(!list->isVisible() && !w.isSeen(coronalViewId), "that is the main window's");
  QVERIFY(w.click(axialViewId));
  QTest::keyClick(w.window.focusWidget(), Qt::Key_Escape);
  QVERIFY(list->isVisible() && w.isSeen(coronalViewId));
}

void TestSecondWindowViews::tabAndF6GoThroughBothWindows() {
  Beside w;
  QVERIFY(w.isOpen);
  w.child<QAction>("layoutTwo")->trigger();
  w.press(Qt::Key_Tab);
  QCOMPARE(w.workspace().focus, besideSecond);
  QCOMPARE(w.beside().focusWidget(), w.views().viewOf(besideSecond));
  w.press(Qt::Key_Tab);
  QCOMPARE(w.workspace().focus, besideFirst);
  w.press(Qt::Key_Backtab, Qt::ShiftModifier);
  QCOMPARE(w.workspace().focus, besideSecond);
  w.press(Qt::Key_F6);
  QTRY_VERIFY_WITH_TIMEOUT(w.window.isActiveWindow(), longest);
  QCOMPARE(w.workspace().focus, axialViewId);
  QCOMPARE(w.window.focusWidget(), w.views().viewOf(axialViewId));
  QTest::keyClick(w.window.focusWidget(), Qt::Key_F6, Qt::ShiftModifier);
  QTRY_VERIFY_WITH_TIMEOUT(w.beside().isActiveWindow(), longest);
  QVERIFY2(w.workspace().focus == besideSecond, "the view that had it last");
  QVERIFY(w.activate(w.window));
  QVERIFY2(w.workspace().focus == besideSecond, "a window that becomes active takes no focus");
}

void TestSecondWindowViews::allViewsAreThoseOfTheWindowInFocus() {
  Beside w;
  QVERIFY(w.isOpen);
  w.child<QAction>("layoutTwo")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(!w.view(besideFirst)->picture().isNull(), longest);
  const QImage all = copiedAllViews(w.beside().focusWidget());
  QCOMPARE(all.size(), w.beside().size());
  QCOMPARE(all.copy(w.view(besideFirst)->geometry()), w.view(besideFirst)->capture());
  QVERIFY(w.click(axialViewId));
  QCOMPARE(copiedAllViews(w.window.focusWidget()).size(), w.views().size());
}

// A screen may have more pixels although no view is resized.
void TestSecondWindowViews::aScreenOfOtherPixelsIsFollowed() {
  Beside w;
  QVERIFY(w.isOpen);
  const QSignalSpy here(w.view(besideFirst), &View::pixelsChanged);
  const QSignalSpy there(w.view(axialViewId), &View::pixelsChanged);
  Q_EMIT w.beside().windowHandle()->screenChanged(w.beside().screen());
  QCOMPARE(here.count(), 1);
  QCOMPARE(there.count(), 0);
}

VOLUMEN_TEST(TestSecondWindowViews);
#include "tst_second_window_views.moc"
