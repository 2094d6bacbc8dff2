// Guards that panels belong to the view in focus. Tabs of one kind of view replace those of the other, and
// return as they were left. No panel shows the curve of a series that is not in focus. A maximised view keeps
// tools and the status line. Real mouse and key events.
#include <QDockWidget>
#include <QSettings>
#include <QStatusBar>
#include <QToolBar>

#include "tests/ui/clean_settings.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/explained.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct Docks : MeasureWindow {
  Docks() { window.resize(1440, 900); }

  QDockWidget* dock(const char* name) { return child<QDockWidget>((QByteArray(name) + "Dock").constData()); }
  // Hidden tabs lie outside the window.
  bool inFront(const char* name) { return dock(name)->isVisible() && dock(name)->geometry().right() >= 0; }
  void click(ViewId id) { QTest::mouseClick(window.views()->viewOf(id), Qt::LeftButton, {}, {40, 200}); }
};

#define IN_FRONT(w, above, below)  \
  QTRY_VERIFY((w).inFront(above)); \
  QTRY_VERIFY((w).inFront(below))

QString sentenceOf(Journey& w, const char* dock) {
  return w.child<QDockWidget>(dock)->findChild<Explained*>()->sentence();
}

}  // namespace

class TestPanelsOfFocus : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void tabsFollowTheKindOfView();
  void aChosenTabComesBackWithItsKind();
  void whatIsAboutBothStays();
  void frontsAreKept();
  void keysStayWhereTheyAre();
  void anotherSeriesHidesTheCurve();
  void oneSeriesKeepsIt();
  void emptyPanelsSayWhy();
  void aViewAloneKeepsToolsAndStatus();
  void whatIsHiddenIsNotTurned();
};

void TestPanelsOfFocus::tabsFollowTheKindOfView() {
  Docks w;
  IN_FRONT(w, "flat", "measurements");
  QVERIFY(!w.inFront("transfer") && !w.inFront("lights"));
  w.click(sceneViewId);
  IN_FRONT(w, "transfer", "lights");
  QVERIFY(!w.inFront("flat") && !w.inFront("measurements"));
  w.click(coronalViewId);
  IN_FRONT(w, "flat", "measurements");
}

void TestPanelsOfFocus::aChosenTabComesBackWithItsKind() {
  Docks w;
  IN_FRONT(w, "flat", "measurements");
  w.dock("lights")->raise();  // as a click on its tab does
  QTRY_VERIFY(w.inFront("lights"));
  w.click(coronalViewId);
  QVERIFY2(w.inFront("lights"), "from slice to slice nothing moves");
  w.click(sceneViewId);
  w.dock("snapshot")->raise();
  IN_FRONT(w, "transfer", "snapshot");
  w.click(axialViewId);
  IN_FRONT(w, "flat", "lights");
  w.click(sceneViewId);
  IN_FRONT(w, "transfer", "snapshot");
}

void TestPanelsOfFocus::whatIsAboutBothStays() {
  Docks w;
  w.dock("segment")->raise();
  QTRY_VERIFY(w.inFront("segment"));
  for (const ViewId id : {sceneViewId, axialViewId, sceneViewId}) {
    w.click(id);
    IN_FRONT(w, id == sceneViewId ? "transfer" : "flat", "segment");
  }
}

void TestPanelsOfFocus::frontsAreKept() {
  {
    Docks w;
    w.click(sceneViewId);
    w.dock("snapshot")->raise();
    w.click(axialViewId);
    IN_FRONT(w, "flat", "measurements");
    w.window.close();
  }
  Docks again;
  IN_FRONT(again, "flat", "measurements");
  again.click(sceneViewId);
  IN_FRONT(again, "transfer", "snapshot");
}

void TestPanelsOfFocus::keysStayWhereTheyAre() {
  Docks w;
  for (const ViewId id : {sceneViewId, axialViewId}) {
    w.click(id);
    QCOMPARE(w.window.focusWidget(), static_cast<QWidget*>(w.window.views()->viewOf(id)));
  }
}

void TestPanelsOfFocus::anotherSeriesHidesTheCurve() {
  TwoSeries w(ballIn("A"), ballIn("B"));
  w.session().showAs(left, ViewKind::volume);
  w.session().setFocus(left);
  QCOMPARE(sentenceOf(w, "transferDock"), QString());
  QTest::mouseClick(w.view(right), Qt::LeftButton, {}, {60, 60});
  for (const char* dock : {"transferDock", "lightsDock", "segmentDock", "clipDock"})
    QCOMPARE(sentenceOf(w, dock), QStringLiteral("Click a 3D view to set how it is drawn."));
  QVERIFY(!w.child<QWidget>("curveEditor")->isVisible());
  w.session().setFocus(left);
  QCOMPARE(sentenceOf(w, "transferDock"), QString());
  QVERIFY(w.child<QWidget>("curveEditor")->isVisible());
  // Without a 3D view on screen, the curve would be that of a hidden view.
  w.session().showAs(left, ViewKind::axial);
  w.session().setFocus(right);
  QVERIFY2(sentenceOf(w, "transferDock").contains(QStringLiteral("Show in this view")),
           qPrintable(sentenceOf(w, "transferDock")));
}

void TestPanelsOfFocus::oneSeriesKeepsIt() {
  Docks w;
  for (const ViewId id : {axialViewId, sceneViewId, sagittalViewId}) {
    w.click(id);
    QCOMPARE(sentenceOf(w, "transferDock"), QString());
  }
}

void TestPanelsOfFocus::emptyPanelsSayWhy() {
  Journey w;
  QCOMPARE(sentenceOf(w, "transferDock"), QStringLiteral("Open a series first."));
  QVERIFY(!sentenceOf(w, "flatDock").isEmpty());
  w.window.session().show(ballSeries());
  QCOMPARE(sentenceOf(w, "transferDock"), QString());
  w.window.session().closeAll({});
  QCOMPARE(sentenceOf(w, "transferDock"), QStringLiteral("Open a series first."));
}

void TestPanelsOfFocus::aViewAloneKeepsToolsAndStatus() {
  Docks w;
  const int width = w.view()->width();
  auto* tools = w.child<QToolBar>("tools");
  QTest::mouseDClick(w.view(), Qt::LeftButton, {}, {60, 60});
  QTRY_VERIFY(w.view()->width() > 2 * width);
  QVERIFY(tools->isVisible() && w.window.statusBar()->isVisible());
  QVERIFY(!w.dock("flat")->isVisible() && !w.window.view()->isVisible());
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QTRY_COMPARE(w.view()->width(), width);
  QVERIFY(tools->isVisible() && w.window.statusBar()->isVisible());
  IN_FRONT(w, "flat", "measurements");
}

void TestPanelsOfFocus::whatIsHiddenIsNotTurned() {
  Docks w;
  w.session().setFocus(sceneViewId);
  w.child<QAction>("maximise")->trigger();
  w.session().setFocus(axialViewId);  // as a list of findings does
  QVERIFY(!w.view()->isVisible());
  const Workspace before = w.session().workspace();
  QTest::keyClick(&w.window, Qt::Key_R, Qt::ControlModifier);
  QVERIFY(w.session().workspace() == before);
  QVERIFY(w.child<Banner>("banner")->isVisible());
}

VOLUMEN_TEST(TestPanelsOfFocus);
#include "tst_panels_of_focus.moc"
