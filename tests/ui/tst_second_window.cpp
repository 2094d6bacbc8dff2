// Guards the second window: it is opened by a key, holds a grid of its own on the same workspace, in which
// series are dropped, scrolled with those of the main window, measured and enlarged by the same keys; closing
// it is a step; it is saved with the session, comes back where it stood, and goes with the main window. Real
// events.
#include <QClipboard>
#include <QDockWidget>
#include <QMenu>
#include <QTemporaryDir>
#include <QToolButton>
#include <QTreeWidget>
#include <QUrl>

#include "tests/ui/browser_window.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/session_folder.h"
#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "ui/tools/tool.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr ViewId first = firstSecondId, second = firstSecondId + 1;

ViewWindow& windowOf(Journey& w) { return w.window.views()->secondWindow(); }

// Opens it as a reader does; it has the keys then.
bool opened(Journey& w) {
  QCoreApplication::processEvents();
  QTest::keyClick(&w.window, Qt::Key_N, Qt::ControlModifier | Qt::ShiftModifier);
  return QTest::qWaitFor([&] { return windowOf(w).isVisible() && windowOf(w).isActiveWindow(); }, longest);
}

// Planes of a series in the main window, another one of the same frame of reference beside them.
struct Beside : MeasureWindow {
  const LoadedSeriesPtr series = ballIn("A");
  const bool isOpen = opened(*this);

  Beside() : MeasureWindow(ballIn("A")) { session().show(series, first); }

  const Workspace& workspace() { return session().workspace(); }
  ViewGrid& views() { return *window.views(); }
  QWidget& beside() { return windowOf(*this); }
  double z(ViewId id) { return view(id)->plane()->centre.z; }
  // A key for what has the keys in the second window.
  void press(Qt::Key key, Qt::KeyboardModifiers keys = {}) {
    QTest::keyClick(beside().focusWidget(), key, keys);
  }
  // A click in a view brings its window to the front.
  bool click(ViewId id) {
    QTest::mouseClick(views().viewOf(id), Qt::LeftButton, {}, {5, 5});
    QWidget* clicked = views().viewOf(id)->window();
    return QTest::qWaitFor([&] { return clicked->isActiveWindow() && workspace().focus == id; }, longest);
  }
  bool isSeen(ViewId id) { return views().viewOf(id)->isVisible(); }
};

QImage copiedAll(QWidget* with) {
  QApplication::clipboard()->clear();
  QTest::keyClick(with, Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
  return QApplication::clipboard()->image().convertToFormat(QImage::Format_RGB32);
}

}  // namespace

class TestSecondWindow : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void aKeyOpensItAndUndoClosesIt();
  void closedAndOpenedAgainItShowsTheSame();
  void aSeriesIsDroppedIntoIt();
  void filesAreDroppedOnIt();
  void eitherWindowScrollsTheOther();
  void keysActOnItsViews();
  void whatIsMeasuredInItIsUndoneInIt();
  void itsGridIsChosenWhileItHasTheFocus();
  void layoutsOfOneGroupAreOfTheMainWindow();
  void emptyViewsSayWhatToDo();
  void aViewIsEnlargedWithinItsWindow();
  void tabAndF6GoThroughBothWindows();
  void allViewsAreThoseOfTheWindowInFocus();
  void anotherPatientOpensInTheMainWindow();
  void closingAllLeavesItOpen();
  void itIsSavedWithTheSession();
  void itsPlaceIsRemembered_data();
  void itsPlaceIsRemembered();
  void closedItStaysClosed();
};

void TestSecondWindow::aKeyOpensItAndUndoClosesIt() {
  MeasureWindow w;
  const Workspace before = w.session().workspace();
  const int steps = w.session().undoStack().count();
  QVERIFY(!w.child<QAction>("secondWindow")->isChecked());
  QVERIFY(opened(w));
  QVERIFY(w.child<QAction>("secondWindow")->isChecked());
  QCOMPARE(w.session().undoStack().count(), steps + 1);
  QCOMPARE(w.session().workspace().focus, first);
  View* view = w.window.views()->viewOf(first);
  QVERIFY(view->isVisible() && view->window() == &windowOf(w));
  QVERIFY2(windowOf(w).focusWidget() == view, "it has the keys");
  QCOMPARE(view->geometry(), windowOf(w).rect());
  QVERIFY2(w.view()->isVisible() && w.view()->window() == &w.window, "the main window shows what it did");
  w.undo();
  QVERIFY(!windowOf(w).isVisible());
  QVERIFY(w.session().workspace() == before);
  QVERIFY(!w.child<QAction>("secondWindow")->isChecked());
  w.redo();
  QVERIFY(windowOf(w).isVisible());
  QCOMPARE(w.session().workspace().focus, first);
}

void TestSecondWindow::closedAndOpenedAgainItShowsTheSame() {
  Beside w;
  QVERIFY(w.isOpen);
  const Workspace shown = w.workspace();
  QVERIFY(w.beside().close());
  QVERIFY(!w.beside().isVisible() && w.window.isVisible());
  QVERIFY(!w.workspace().second.shown);
  QCOMPARE(w.workspace().focus, axialViewId);
  w.undo();
  QVERIFY(w.workspace() == shown);
  QVERIFY(w.beside().isVisible() && w.isSeen(first));
  w.redo();
  QVERIFY(!w.beside().isVisible());
  w.window.activateWindow();
  QTRY_VERIFY(w.window.isActiveWindow());
  QVERIFY(opened(w));
  QVERIFY(w.workspace() == shown);
  w.press(Qt::Key_N, Qt::ControlModifier | Qt::ShiftModifier);
  QVERIFY2(!w.beside().isVisible(), "the key closes it, too");
}

void TestSecondWindow::aSeriesIsDroppedIntoIt() {
  Journey w({QStringLiteral("phantom:sphere:24"), QStringLiteral("phantom:cube:16")});
  QVERIFY(w.settle());
  auto* tree = w.child<QTreeWidget>("studyTree");
  const auto cubes = [&] {
    return tree->findItems(QStringLiteral("cube"), Qt::MatchContains | Qt::MatchRecursive);
  };
  QTRY_COMPARE_WITH_TIMEOUT(cubes().size(), 1, longest);
  QVERIFY(opened(w));
  const Workspace before = w.window.session().workspace();
  const std::unique_ptr<QMimeData> data(tree->model()->mimeData({tree->indexFromItem(cubes().front())}));
  QVERIFY(drop(*data, w.window.views()->viewOf(first)));
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().seriesOf(first), longest);
  const Workspace& after = w.window.session().workspace();
  QVERIFY(seriesIn(after, first)->path.find("cube") != std::string::npos);
  QVERIFY(after.layout == before.layout && after.view(sceneViewId) == before.view(sceneViewId));
  QCOMPARE(viewsInMain(after), viewsInMain(before));
  QTRY_VERIFY_WITH_TIMEOUT(!w.window.views()->viewAs<FlatView>(first)->picture().isNull(), longest);
}

void TestSecondWindow::filesAreDroppedOnIt() {
  const SessionFolder folder;
  Journey w;
  QVERIFY(opened(w));
  QMimeData files;
  files.setUrls({QUrl::fromLocalFile(folder.ct())});
  QVERIFY(drop(files, &windowOf(w)));
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().seriesOf(first), longest);
}

void TestSecondWindow::eitherWindowScrollsTheOther() {
  Beside w;
  QVERIFY(w.isOpen);
  QCOMPARE(w.z(first), w.z(axialViewId));
  const double before = w.z(first);
  wheel(w.view(first), -3);
  w.session().endGesture();
  QVERIFY(std::abs(w.z(first) - before) > 0.5);
  QCOMPARE(w.z(axialViewId), w.z(first));
  wheel(w.view(axialViewId), 5);
  w.session().endGesture();
  QVERIFY(w.z(axialViewId) != before);
  QCOMPARE(w.z(first), w.z(axialViewId));
  QTRY_VERIFY_WITH_TIMEOUT(!w.view(first)->picture().isNull(), longest);
}

void TestSecondWindow::keysActOnItsViews() {
  Beside w;
  QVERIFY(w.isOpen);
  const double before = w.z(first);
  w.press(Qt::Key_Down);
  QVERIFY(w.z(first) != before);
  for (const auto& [key, tool] :
       {std::pair(Qt::Key_M, "pan"), {Qt::Key_B, "scroll"}, {Qt::Key_D, "length"}}) {
    w.press(key);
    QCOMPARE(QByteArray(w.views().tool().name), QByteArray(tool));
  }
  w.press(Qt::Key_Menu);
  auto* menu = w.beside().findChild<QMenu*>(QStringLiteral("flatMenu"));
  QVERIFY(menu && menu->isVisible());
  menu->close();
  // As by its menu.
  w.child<QAction>("show3D")->trigger();
  QVERIFY(w.workspace().view(first).kind == ViewKind::volume && w.isSeen(first));
  QVERIFY(w.views().viewOf(first)->window() == &w.beside());
  QCOMPARE(w.window.view(), w.views().volumeView(first));
}

void TestSecondWindow::whatIsMeasuredInItIsUndoneInIt() {
  Beside w;
  QVERIFY(w.isOpen);
  const Workspace before = w.workspace();
  w.press(Qt::Key_D);
  const QPointF middle = w.view(first)->rect().center();
  drag(w.view(first), middle - QPointF(30, 0), middle + QPointF(30, 20));
  QCOMPARE(w.all().size(), std::size_t(1));
  QVERIFY(w.last().series == keyOf(w.series->series));
  w.press(Qt::Key_Z, Qt::ControlModifier);
  QVERIFY(w.all().empty());
  QVERIFY(w.workspace() == before);
}

void TestSecondWindow::itsGridIsChosenWhileItHasTheFocus() {
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
  for (ViewId id = first; id < first + 6; ++id) {
    QVERIFY(w.isSeen(id) && w.views().viewOf(id)->window() == &w.beside());
    QVERIFY(w.beside().rect().contains(w.views().viewOf(id)->geometry()));
    for (ViewId other = first; other < id; ++other)
      QVERIFY(!w.views().viewOf(id)->geometry().intersects(w.views().viewOf(other)->geometry()));
  }
  for (const ViewId id : viewsInMain(w.workspace())) QVERIFY(w.isSeen(id));
  w.undo();
  QVERIFY(w.workspace() == before);
  QVERIFY(w.isSeen(first) && !w.isSeen(second));
}

void TestSecondWindow::layoutsOfOneGroupAreOfTheMainWindow() {
  Beside w;
  QVERIFY(w.isOpen);
  for (const char* name : {"layoutPlanes", "layoutBesidePlanes"})
    QVERIFY(!w.child<QAction>(name)->isEnabled());
  QVERIFY2(w.child<QAction>("layoutOne")->isChecked(), "there is one view");
  w.press(Qt::Key_5, Qt::AltModifier);
  QVERIFY(w.workspace().second.layout == Layout::four && w.isSeen(first + 3));
  QVERIFY(w.child<QAction>("layoutFour")->isChecked() && w.workspace().layout == Layout::planes);
  w.press(Qt::Key_1, Qt::AltModifier);
  QVERIFY(!w.isSeen(second));
  QVERIFY(w.click(axialViewId));
  QVERIFY(w.child<QAction>("layoutPlanes")->isEnabled() && w.child<QAction>("layoutPlanes")->isChecked());
  w.child<QAction>("layoutOne")->trigger();
  QVERIFY(w.workspace().layout == Layout::one && w.isSeen(axialViewId));
  QVERIFY(w.click(first));
  QVERIFY2(w.isSeen(axialViewId) && !w.isSeen(sceneViewId), "the main window shows the view it showed");
}

void TestSecondWindow::emptyViewsSayWhatToDo() {
  Beside w;
  QVERIFY(w.isOpen);
  w.child<QAction>("layoutTwo")->trigger();
  const auto isBlank = [](const QImage& picture) {
    for (int y = 4; y < picture.height() - 4; ++y)
      for (int x = 4; x < picture.width() - 4; ++x)
        if (qGreen(picture.pixel(x, y)) > 100) return false;
    return true;
  };
  QVERIFY(!isBlank(w.views().viewOf(second)->grab().toImage()));
  QVERIFY(isBlank(w.views().viewOf(second)->capture()));
}

void TestSecondWindow::aViewIsEnlargedWithinItsWindow() {
  Beside w;
  QVERIFY(w.isOpen);
  w.child<QAction>("layoutTwo")->trigger();
  QVERIFY(w.isSeen(second));
  QAction* maximise = w.child<QAction>("maximise");
  auto* list = w.child<QDockWidget>("studiesDock");
  QTest::mouseDClick(w.view(first), Qt::LeftButton, {}, {5, 5});
  QVERIFY(maximise->isChecked() && !w.isSeen(second));
  QCOMPARE(w.view(first)->geometry(), w.beside().rect());
  QVERIFY2(list->isVisible() && w.isSeen(coronalViewId), "the main window stays as it is");
  QVERIFY(w.click(axialViewId));
  QVERIFY2(!maximise->isChecked() && !w.isSeen(second), "that is the main window's");
  QTest::keyClick(w.window.focusWidget(), Qt::Key_F10);
  QVERIFY(!list->isVisible() && !w.isSeen(coronalViewId) && w.isSeen(axialViewId));
  QVERIFY(w.click(first));
  QVERIFY(maximise->isChecked());
  w.press(Qt::Key_Escape);
  QVERIFY(w.isSeen(second) && !maximise->isChecked());
  QVERIFY2(!list->isVisible() && !w.isSeen(coronalViewId), "that is the main window's");
  QVERIFY(w.click(axialViewId));
  QTest::keyClick(w.window.focusWidget(), Qt::Key_Escape);
  QVERIFY(list->isVisible() && w.isSeen(coronalViewId));
}

void TestSecondWindow::tabAndF6GoThroughBothWindows() {
  Beside w;
  QVERIFY(w.isOpen);
  w.child<QAction>("layoutTwo")->trigger();
  w.press(Qt::Key_Tab);
  QCOMPARE(w.workspace().focus, second);
  QCOMPARE(w.beside().focusWidget(), w.views().viewOf(second));
  w.press(Qt::Key_Tab);
  QCOMPARE(w.workspace().focus, first);
  w.press(Qt::Key_Backtab, Qt::ShiftModifier);
  QCOMPARE(w.workspace().focus, second);
  w.press(Qt::Key_F6);
  QTRY_VERIFY_WITH_TIMEOUT(w.window.isActiveWindow(), longest);
  QCOMPARE(w.workspace().focus, axialViewId);
  QCOMPARE(w.window.focusWidget(), w.views().viewOf(axialViewId));
  QTest::keyClick(w.window.focusWidget(), Qt::Key_F6, Qt::ShiftModifier);
  QTRY_VERIFY_WITH_TIMEOUT(w.beside().isActiveWindow(), longest);
  QVERIFY2(w.workspace().focus == second, "the view that had it last");
  // As by the system's own keys.
  w.window.activateWindow();
  QTRY_COMPARE_WITH_TIMEOUT(w.workspace().focus, axialViewId, longest);
  w.beside().activateWindow();
  QTRY_COMPARE_WITH_TIMEOUT(w.workspace().focus, second, longest);
}

void TestSecondWindow::allViewsAreThoseOfTheWindowInFocus() {
  Beside w;
  QVERIFY(w.isOpen);
  w.child<QAction>("layoutTwo")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(!w.view(first)->picture().isNull(), longest);
  const QImage all = copiedAll(w.beside().focusWidget());
  QCOMPARE(all.size(), w.beside().size());
  QCOMPARE(all.copy(w.view(first)->geometry()), w.view(first)->capture());
  QVERIFY(w.click(axialViewId));
  QCOMPARE(copiedAll(w.window.focusWidget()).size(), w.views().size());
}

// A study of the same patient opens in the view in focus, here too.
void TestSecondWindow::anotherPatientOpensInTheMainWindow() {
  const Studies studies;
  QVERIFY(studies.import());
  BrowserWindow w(studies);
  QVERIFY(w.openHead());
  QVERIFY(opened(w));
  const auto open = [&](const QModelIndex& row) {
    w.child<QAction>("showBrowser")->trigger();
    w.doubleClick(row);
  };
  QVERIFY(w.has("Follow-up", 4));
  open(w.row("Follow-up", 4));
  QVERIFY(w.isShown("Scout", first));
  QVERIFY(w.isShown("Bone", sceneViewId));
  QCOMPARE(w.window.session().workspace().focus, first);
  open(w.row("Müller"));
  QVERIFY(w.isShown("Venous"));
  const Workspace& after = w.window.session().workspace();
  QVERIFY(!isInSecond(after.focus));
  QVERIFY(after.second.shown && after.view(first).series.empty());
}

void TestSecondWindow::closingAllLeavesItOpen() {
  Beside w;
  QVERIFY(w.isOpen);
  w.session().closeAll({});
  QVERIFY(w.workspace().second.shown && w.beside().isVisible());
  QVERIFY(w.workspace().view(first).series.empty());
  w.undo();
  QVERIFY(w.workspace().view(first).series == keyOf(w.series->series));
}

void TestSecondWindow::itIsSavedWithTheSession() {
  const SessionFolder folder;
  Journey w({folder.ct()});
  QVERIFY(w.settle());
  QVERIFY(opened(w));
  w.window.session().show(w.window.session().series(), second);
  w.child<QAction>("layoutTwo")->trigger();
  const Workspace saved = w.window.session().workspace();
  QVERIFY(saved.second.layout == Layout::two);
  QVERIFY(folder.save(w));
  Journey again;
  QVERIFY(!windowOf(again).isVisible());
  QVERIFY(settles(again, [&] { again.window.open({folder.at("s.volumen")}); }));
  QTRY_VERIFY_WITH_TIMEOUT(windowOf(again).isVisible(), longest);
  QVERIFY(withFocusOf(again.window.session().workspace(), saved) == saved);
  for (const ViewId id : {first, second}) QVERIFY(again.window.views()->viewOf(id)->isVisible());
}

void TestSecondWindow::itsPlaceIsRemembered_data() {
  QTest::addColumn<bool>("isMaximised");
  QTest::newRow("where it stood") << false;
  QTest::newRow("maximised") << true;
}

void TestSecondWindow::itsPlaceIsRemembered() {
  QFETCH(bool, isMaximised);
  const QRect place(120, 140, 420, 310);
  {
    Journey w;
    QVERIFY(opened(w));
    windowOf(w).setGeometry(place);
    if (isMaximised) windowOf(w).showMaximized();
    QCoreApplication::processEvents();
    w.window.close();
    QVERIFY2(!w.window.isVisible() && !windowOf(w).isVisible(), "it goes with the main window");
  }
  Journey w;
  QTRY_VERIFY_WITH_TIMEOUT(windowOf(w).isVisible(), longest);
  QCOMPARE(windowOf(w).isMaximized(), isMaximised);
  QVERIFY(!w.window.session().undoStack().canUndo());
  QVERIFY(w.child<QAction>("secondWindow")->isChecked());
  if (isMaximised) return;
  QCOMPARE(windowOf(w).size(), place.size());
  constexpr int frame = 40;  // of a window, which systems draw as they like
  const QPoint off = windowOf(w).pos() - place.topLeft();
  QVERIFY2(std::abs(off.x()) <= frame && std::abs(off.y()) <= frame,
           qPrintable(QStringLiteral("%1").arg(off.y())));
}

void TestSecondWindow::closedItStaysClosed() {
  {
    Journey w;
    QVERIFY(opened(w));
    w.window.close();
  }
  {
    Journey w;
    QTRY_VERIFY_WITH_TIMEOUT(windowOf(w).isVisible(), longest);
    windowOf(w).close();
    w.window.close();
  }
  Journey w;
  for (int n = 0; n < 5; ++n) QCoreApplication::processEvents();
  QVERIFY(w.window.isVisible() && !windowOf(w).isVisible());
}

VOLUMEN_TEST(TestSecondWindow);
#include "tst_second_window.moc"
