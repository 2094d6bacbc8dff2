// Guards how brush strokes end, by real events: surfaces and jobs wait for them, they are cancelled or
// undone, or their series is closed.
#include <QPointer>

#include "tests/ui/paint_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestStrokeEnds : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void surfacesWaitForTheEndOfAStroke();
  void escGivesAStrokeUp();
  void aJobThatEndsInAStrokeIsTheStepAfterIt_data();
  void aJobThatEndsInAStrokeIsTheStepAfterIt();
  void aSeriesThatIsClosedInAStroke();
  void aStrokeThatIsUndoneIsOver();
};

void TestStrokeEnds::surfacesWaitForTheEndOfAStroke() {
  PaintWindow w;
  w.show(throughMiddle());
  w.take("paintTool");
  const std::vector<QPoint> way = w.pixelsOf(throughBall, axialViewId);
  w.press(way.front());
  for (const QPoint p : way) {
    w.move(p);
    QVERIFY(!QTest::qWaitFor([&] { return !w.scenes().surfaces().entries().empty(); }, 100));
  }
  w.release(way.back());
  QTRY_COMPARE_WITH_TIMEOUT(w.scenes().surfaces().entries().size(), std::size_t(1), longest);
}

void TestStrokeEnds::escGivesAStrokeUp() {
  PaintWindow w;
  w.take("paintTool");
  const Workspace before = w.workspace();
  const int steps = w.steps();
  const QPoint at = w.view()->rect().center();
  w.press(at);
  w.move(at + QPoint(20, 0));
  QCOMPARE(w.count(), std::size_t(1));
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QVERIFY(w.workspace() == before);
  w.move(at + QPoint(40, 0));
  w.release(at + QPoint(40, 0));
  QVERIFY(w.workspace() == before && w.steps() == steps);
  QVERIFY(w.idle());
  w.stroke({at});
  QCOMPARE(w.steps(), steps + 1);
}

void TestStrokeEnds::aJobThatEndsInAStrokeIsTheStepAfterIt_data() {
  QTest::addColumn<bool>("isGivenUp");
  QTest::newRow("the stroke is drawn to its end") << false;
  QTest::newRow("Esc gives the stroke up") << true;
}

// The result is as if the step had been requested after the stroke.
void TestStrokeEnds::aJobThatEndsInAStrokeIsTheStepAfterIt() {
  QFETCH(bool, isGivenUp);
  PaintWindow w;
  QVERIFY(w.makeBoth());
  w.show(throughMiddle());
  w.take("paintTool");
  w.chooseStep("grow");
  w.session().setFocus(axialViewId);  // as the press does
  const std::vector<QPoint> way = w.pixelsOf({{0, 5, -5}, {6, 5, -5}, {12, 5, -5}}, axialViewId);
  const int steps = w.steps();
  const SegmentMap before = *w.map();
  if (!isGivenUp) w.stroke(way);
  const SegmentMap painted = *w.map();
  QVERIFY(w.step("grow"));
  const SegmentMap expected = *w.map();
  while (w.steps() > steps) w.undo();
  QVERIFY(w.idle() && *w.map() == before);
  w.click("segmentApply");
  w.press(way[0]);
  QVERIFY(w.idle());  // the job ends
  QTest::qWait(50);
  w.move(way[1]);
  QVERIFY(w.idle());
  QTest::qWait(50);
  QCOMPARE(w.steps(), steps + 1);
  w.move(way[2]);
  if (isGivenUp) QTest::keyClick(w.view(), Qt::Key_Escape);
  w.release(way[2]);
  QTRY_COMPARE_WITH_TIMEOUT(w.steps(), steps + (isGivenUp ? 1 : 2), longest);
  QVERIFY(w.idle() && *w.map() == expected);
  w.undo();
  QVERIFY(w.idle() && *w.map() == painted);
  if (!isGivenUp) w.undo();
  QVERIFY(w.idle() && *w.map() == before);
}

void TestStrokeEnds::aSeriesThatIsClosedInAStroke() {
  PaintWindow w;
  w.take("paintTool");
  const QPointer<FlatView> view = w.view();
  const QPoint at = view->rect().center();
  w.press(at);
  w.move(at + QPoint(20, 0));
  const Workspace painted = w.workspace();
  w.session().close({w.series()});
  QVERIFY(w.workspace().segmentMaps.empty());
  if (view) QTest::mouseEvent(QTest::MouseMove, view, Qt::LeftButton, {}, at + QPoint(40, 0));
  if (view) QTest::mouseRelease(view, Qt::LeftButton, {}, at + QPoint(40, 0));
  QVERIFY(w.idle());
  QVERIFY(w.workspace().segmentMaps.empty());
  w.undo();
  QVERIFY(w.workspace() == painted);
}

void TestStrokeEnds::aStrokeThatIsUndoneIsOver() {
  PaintWindow w;
  w.take("paintTool");
  const Workspace before = w.workspace();
  const QPoint at = w.view()->rect().center();
  w.press(at);
  w.move(at + QPoint(20, 0));
  w.session().undoStack().undo();
  QVERIFY(w.workspace() == before);
  w.move(at + QPoint(40, 0));
  w.release(at + QPoint(40, 0));
  QVERIFY(w.workspace() == before);
}

VOLUMEN_TEST(TestStrokeEnds);
#include "tst_stroke_ends.moc"
