// Guards the second window. A key opens it, series and files are dropped into it, and closing it is an undo
// step. It is saved with the session, returns to its position, and closes with the main window. Real events.
#include <QPointer>
#include <QScreen>
#include <QTemporaryDir>
#include <QTreeWidget>
#include <QUrl>

#include "tests/ui/browser_window.h"
#include "tests/ui/clean_settings.h"
#include "tests/ui/second_window.h"
#include "tests/ui/session_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestSecondWindow : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void aKeyOpensItAndUndoClosesIt();
  void closedAndOpenedAgainItShowsTheSame();
  void aSeriesIsDroppedIntoIt();
  void filesOpenWhereTheyAreDropped_data();
  void filesOpenWhereTheyAreDropped();
  void anotherPatientOpensInTheMainWindow();
  void closingAllLeavesItOpen();
  void itIsSavedWithTheSession();
  void dialogsStandOverTheWindowInUse();
  void itsPlaceIsRemembered_data();
  void itsPlaceIsRemembered();
  void itOpensOnAScreenThatIsThere();
  void closedItStaysClosed();
};

void TestSecondWindow::aKeyOpensItAndUndoClosesIt() {
  MeasureWindow w;
  const Workspace before = w.session().workspace();
  const int steps = w.session().undoStack().count();
  QVERIFY(!w.child<QAction>("secondWindow")->isChecked());
  QVERIFY(opensSecondWindow(w));
  QVERIFY(w.child<QAction>("secondWindow")->isChecked());
  QCOMPARE(w.session().undoStack().count(), steps + 1);
  QCOMPARE(w.session().workspace().focus, besideFirst);
  View* view = w.window.views()->viewOf(besideFirst);
  QVERIFY(view->isVisible() && view->window() == &secondWindowOf(w));
  QVERIFY2(secondWindowOf(w).focusWidget() == view, "it has the keys");
  QCOMPARE(view->geometry(), secondWindowOf(w).rect());
  QVERIFY2(w.view()->isVisible() && w.view()->window() == &w.window, "the main window shows what it did");
  w.undo();
  QVERIFY(!secondWindowOf(w).isVisible());
  QVERIFY(w.session().workspace() == before);
  QVERIFY(!w.child<QAction>("secondWindow")->isChecked());
  w.redo();
  QVERIFY(secondWindowOf(w).isVisible());
  QCOMPARE(w.session().workspace().focus, besideFirst);
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
  QVERIFY(w.beside().isVisible() && w.isSeen(besideFirst));
  QTRY_VERIFY_WITH_TIMEOUT(w.beside().isActiveWindow(), longest);
  w.redo();
  QVERIFY(!w.beside().isVisible());
  QTRY_VERIFY_WITH_TIMEOUT(w.window.isActiveWindow(), longest);
  QVERIFY(opensSecondWindow(w));
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
  QVERIFY(opensSecondWindow(w));
  const Workspace before = w.window.session().workspace();
  const std::unique_ptr<QMimeData> data(tree->model()->mimeData({tree->indexFromItem(cubes().front())}));
  QVERIFY(drop(*data, w.window.views()->viewOf(besideFirst)));
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().seriesOf(besideFirst), longest);
  const Workspace& after = w.window.session().workspace();
  QVERIFY(seriesIn(after, besideFirst)->path.find("cube") != std::string::npos);
  QVERIFY(after.layout == before.layout && after.view(sceneViewId) == before.view(sceneViewId));
  QCOMPARE(viewsInMain(after), viewsInMain(before));
  QTRY_VERIFY_WITH_TIMEOUT(!w.window.views()->viewAs<FlatView>(besideFirst)->picture().isNull(), longest);
}

void TestSecondWindow::filesOpenWhereTheyAreDropped_data() {
  QTest::addColumn<bool>("onSecond");
  QTest::newRow("on it, the focus in the main window") << true;
  QTest::newRow("on the main window, the focus in it") << false;
}

void TestSecondWindow::filesOpenWhereTheyAreDropped() {
  QFETCH(bool, onSecond);
  const SessionFolder folder;
  Journey w;
  QVERIFY(opensSecondWindow(w));
  Session& session = w.window.session();
  session.setFocus(onSecond ? sceneViewId : besideFirst);
  const ViewId there = onSecond ? besideFirst : sceneViewId, other = onSecond ? sceneViewId : besideFirst;
  QMimeData files;
  files.setUrls({QUrl::fromLocalFile(folder.ct())});
  QVERIFY(drop(files, onSecond ? static_cast<QWidget*>(&secondWindowOf(w)) : &w.window));
  QTRY_VERIFY_WITH_TIMEOUT(session.seriesOf(there), longest);
  QCOMPARE(isInSecond(session.workspace().focus), onSecond);
  QVERIFY(session.workspace().view(other).series.empty());
}

void TestSecondWindow::anotherPatientOpensInTheMainWindow() {
  const Studies studies;
  QVERIFY(studies.import());
  BrowserWindow w(studies);
  QVERIFY(w.openHead());
  QVERIFY(opensSecondWindow(w));
  const auto open = [&](const QModelIndex& row) {
    w.child<QAction>("showBrowser")->trigger();
    w.doubleClick(row);
  };
  QVERIFY(w.has("Follow-up", 4));
  open(w.row("Follow-up", 4));
  QVERIFY(w.isShown("Scout", besideFirst));
  QVERIFY(w.isShown("Bone", sceneViewId));
  QCOMPARE(w.window.session().workspace().focus, besideFirst);
  open(w.row("Müller"));
  QVERIFY(w.isShown("Venous"));
  const Workspace& after = w.window.session().workspace();
  QVERIFY(!isInSecond(after.focus));
  QVERIFY(after.second.shown && after.view(besideFirst).series.empty());
}

void TestSecondWindow::closingAllLeavesItOpen() {
  Beside w;
  QVERIFY(w.isOpen);
  w.session().closeAll({});
  QVERIFY(w.workspace().second.shown && w.beside().isVisible());
  QVERIFY(w.workspace().view(besideFirst).series.empty());
  w.undo();
  QVERIFY(w.workspace().view(besideFirst).series == keyOf(w.series->series));
}

void TestSecondWindow::itIsSavedWithTheSession() {
  const SessionFolder folder;
  Journey w({folder.ct()});
  QVERIFY(w.settle());
  QVERIFY(opensSecondWindow(w));
  w.window.session().show(w.window.session().series(), besideSecond);
  w.child<QAction>("layoutTwo")->trigger();
  const Workspace saved = w.window.session().workspace();
  QVERIFY(saved.second.layout == Layout::two);
  QVERIFY(folder.save(w));
  Journey again;
  QVERIFY(!secondWindowOf(again).isVisible());
  QVERIFY(settles(again, [&] { again.window.open({folder.at("s.volumen")}); }));
  QTRY_VERIFY_WITH_TIMEOUT(secondWindowOf(again).isVisible(), longest);
  QVERIFY(withFocusOf(again.window.session().workspace(), saved) == saved);
  for (const ViewId id : {besideFirst, besideSecond}) QVERIFY(again.window.views()->viewOf(id)->isVisible());
}

void TestSecondWindow::dialogsStandOverTheWindowInUse() {
  Beside w;
  QVERIFY(w.isOpen);
  for (QWidget* in : {static_cast<QWidget*>(&w.beside()), static_cast<QWidget*>(&w.window)}) {
    QVERIFY(w.activate(*in));
    QTest::keyClick(in->focusWidget(), Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
    QPointer<QFileDialog> dialog = in->findChild<QFileDialog*>(QStringLiteral("saveSessionDialog"));
    QVERIFY(dialog && dialog->isVisible());
    QVERIFY2(dialog->windowModality() == Qt::ApplicationModal, "the session is of both");
    QTest::keyClick(dialog, Qt::Key_Escape);
    QTRY_VERIFY_WITH_TIMEOUT(!dialog, longest);
    QCOMPARE(w.workspace().focus, besideFirst);
  }
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
    QVERIFY(opensSecondWindow(w));
    secondWindowOf(w).setGeometry(place);
    if (isMaximised) secondWindowOf(w).showMaximized();
    QCoreApplication::processEvents();
    w.window.close();
    QVERIFY2(!w.window.isVisible() && !secondWindowOf(w).isVisible(), "it goes with the main window");
  }
  Journey w;
  QTRY_VERIFY_WITH_TIMEOUT(secondWindowOf(w).isVisible(), longest);
  QCOMPARE(secondWindowOf(w).isMaximized(), isMaximised);
  QVERIFY(!w.window.session().undoStack().canUndo());
  QVERIFY(w.child<QAction>("secondWindow")->isChecked());
  if (isMaximised) return;
  QCOMPARE(secondWindowOf(w).size(), place.size());
  constexpr int frame = 40;  // a window's border, which systems draw as they like
  const QPoint off = secondWindowOf(w).pos() - place.topLeft();
  QVERIFY2(std::abs(off.x()) <= frame && std::abs(off.y()) <= frame,
           qPrintable(QStringLiteral("%1").arg(off.y())));
}

// The last position lies outside all screens, as after a screen was unplugged.
void TestSecondWindow::itOpensOnAScreenThatIsThere() {
  Beside w;
  QVERIFY(w.isOpen);
  QVERIFY(w.beside().close());
  QTRY_VERIFY_WITH_TIMEOUT(w.window.isActiveWindow(), longest);
  const QRect screen = w.window.screen()->virtualGeometry();
  w.beside().setGeometry(QRect(screen.bottomRight() + QPoint(300, 200), QSize(420, 310)));
  QVERIFY(!screen.intersects(w.beside().geometry()));
  QVERIFY(opensSecondWindow(w));
  QVERIFY(screen.contains(w.beside().geometry()));
}

void TestSecondWindow::closedItStaysClosed() {
  {
    Journey w;
    QVERIFY(opensSecondWindow(w));
    w.window.close();
  }
  {
    Journey w;
    QTRY_VERIFY_WITH_TIMEOUT(secondWindowOf(w).isVisible(), longest);
    secondWindowOf(w).close();
    w.window.close();
  }
  Journey w;
  for (int n = 0; n < 5; ++n) QCoreApplication::processEvents();
  QVERIFY(w.window.isVisible() && !secondWindowOf(w).isVisible());
}

VOLUMEN_TEST(TestSecondWindow);
#include "tst_second_window.moc"
