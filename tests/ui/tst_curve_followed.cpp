// Guards segments bound to a span of the curve, by real events. They follow the curve in the same undo step,
// give back voxels they took, and are unbound once changed by hand.
#include <QAction>
#include <QCheckBox>
#include <QComboBox>

#include "tests/ui/axis_window.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

bool isBright(glm::dvec3 p) { return isShell(p) || isSmall(p); }
bool isAnyBall(glm::dvec3 p) { return isBright(p) || isCore(p); }

bool isItalic(AxisWindow& w) { return w.list()->topLevelItem(0)->font(0).italic(); }

}  // namespace

class TestCurveFollowed : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aPulledCurveTakesItsSegmentWithIt_data();
  void aPulledCurveTakesItsSegmentWithIt();
  void beyondAllValuesItIsEmpty();
  void itFollowsWhileTheButtonIsHeld();
  void whatItTakesItGivesBack();
  void twoFollowTheirOwnSpans();
  void whatIsChangedByHandIsLetGo_data();
  void whatIsChangedByHandIsLetGo();
  void anotherOneMayBeChanged();
  void aLockedOneStays();
  void itWaitsWhileTheCurveShowsOtherSpans();
  void undoneMeanwhileItStays();
  void whatIsDoneMeanwhileIsWaitedFor_data();
  void whatIsDoneMeanwhileIsWaitedFor();
};

void TestCurveFollowed::aPulledCurveTakesItsSegmentWithIt_data() {
  QTest::addColumn<bool>("pet");
  QTest::newRow("CT") << false;
  QTest::newRow("PET in SUV") << true;
}

void TestCurveFollowed::aPulledCurveTakesItsSegmentWithIt() {
  QFETCH(bool, pet);
  AxisWindow w(ballsOf(pet));
  QVERIFY(w.makeBound(300));
  QCOMPARE(w.voxels(1), voxelsWhere(isAnyBall));
  QVERIFY(isItalic(w));
  const Workspace before = w.workspace();
  const int steps = w.steps();
  w.pull(0, 560);
  QTRY_VERIFY_WITH_TIMEOUT(w.current().range == w.visible(), longest);
  QVERIFY(w.idle());
  QVERIFY(w.current().range->low > 500);
  QCOMPARE(w.voxels(1), voxelsWhere(isBright));
  QCOMPARE(w.current().label, nameOfRange(*w.current().range, w.session().series()->series));
  QVERIFY((w.current().span == CurveSpan{0, 1}));
  QCOMPARE(w.steps(), steps + 1);
  const Workspace after = w.workspace();
  w.undo();
  QVERIFY(w.idle());
  QVERIFY(w.workspace() == before);
  w.redo();
  QVERIFY(w.idle());
  QVERIFY(w.workspace() == after);
}

void TestCurveFollowed::beyondAllValuesItIsEmpty() {
  AxisWindow w;
  QVERIFY(w.makeBound(300));
  w.pull(0, 1100);
  QTRY_COMPARE_WITH_TIMEOUT(w.voxels(1), 0, longest);
  w.pull(0, 350);
  QTRY_COMPARE_WITH_TIMEOUT(w.voxels(1), voxelsWhere(isAnyBall), longest);
}

void TestCurveFollowed::itFollowsWhileTheButtonIsHeld() {
  AxisWindow w;
  QVERIFY(w.makeBound(300));
  const Workspace before = w.workspace();
  const int steps = w.steps();
  const QPoint from = w.curve()->positionOf(0).toPoint(), to = w.pointAt(0, 560).toPoint();
  QTest::mousePress(w.curve(), Qt::LeftButton, {}, from);
  QTest::mouseEvent(QTest::MouseMove, w.curve(), Qt::LeftButton, {}, to);
  QTRY_COMPARE_WITH_TIMEOUT(w.voxels(1), voxelsWhere(isBright), longest);
  QTest::mouseEvent(QTest::MouseMove, w.curve(), Qt::LeftButton, {}, from + QPoint(5, 0));
  QTRY_COMPARE_WITH_TIMEOUT(w.voxels(1), voxelsWhere(isAnyBall), longest);
  QTest::mouseEvent(QTest::MouseMove, w.curve(), Qt::LeftButton, {}, to);
  QTest::mouseRelease(w.curve(), Qt::LeftButton, {}, to);
  QTRY_COMPARE_WITH_TIMEOUT(w.voxels(1), voxelsWhere(isBright), longest);
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  w.undo();
  QVERIFY(w.workspace() == before);
}

// The core belongs to another segment until the curve reaches it, and again once the curve has left it.
void TestCurveFollowed::whatItTakesItGivesBack() {
  AxisWindow w;
  QVERIFY(w.makeBound(700));
  QVERIFY(w.make(450, 550));
  QCOMPARE(w.voxels(2), voxelsWhere(isCore));
  QVERIFY((w.segment(0).span == CurveSpan{0, 1}));
  const Workspace before = w.workspace();
  const QPoint from = w.curve()->positionOf(0).toPoint(), to = w.pointAt(0, 300).toPoint();
  QTest::mousePress(w.curve(), Qt::LeftButton, {}, from);
  QTest::mouseEvent(QTest::MouseMove, w.curve(), Qt::LeftButton, {}, to);
  QTRY_COMPARE_WITH_TIMEOUT(w.voxels(1), voxelsWhere(isAnyBall), longest);
  QCOMPARE(w.voxels(2), 0);
  QTest::mouseEvent(QTest::MouseMove, w.curve(), Qt::LeftButton, {}, from - QPoint(5, 0));
  QTRY_COMPARE_WITH_TIMEOUT(w.voxels(1), voxelsWhere(isBright), longest);
  QCOMPARE(w.voxels(2), voxelsWhere(isCore));
  QTest::mouseRelease(w.curve(), Qt::LeftButton, {}, from - QPoint(5, 0));
  QVERIFY(w.idle());
  w.undo();
  QVERIFY(w.idle());
  QVERIFY(w.workspace() == before);
}

void TestCurveFollowed::twoFollowTheirOwnSpans() {
  AxisWindow w;
  w.session().edit(QStringLiteral("test"), [](Scene& s) {
    s.transferFunction.points = {
        {300, {1, 1, 1}, 0.0}, {600, {1, 1, 1}, 0.5}, {700, {1, 1, 1}, 0.0}, {1200, {1, 1, 1}, 1.0}};
  });
  w.session().endGesture();
  auto* spans = w.child<QComboBox>("segmentSpans");
  QCOMPARE(spans->count(), 2);
  for (int n : {0, 1}) {
    if (n == 1) {
      spans->setFocus();
      QTest::keyClick(spans, Qt::Key_Down);
    }
    QVERIFY(w.press("segment"));
    QVERIFY(w.press("segmentFollows"));
    QVERIFY((w.current().span == CurveSpan{n, 2}));
  }
  QCOMPARE(w.voxels(1), voxelsWhere(isCore));
  QCOMPARE(w.voxels(2), voxelsWhere(isBright));
  w.pull(0, 560);
  QTRY_COMPARE_WITH_TIMEOUT(w.voxels(1), 0, longest);
  QCOMPARE(w.voxels(2), voxelsWhere(isBright));
  w.pull(2, 800);
  QTRY_VERIFY_WITH_TIMEOUT(w.segment(1).range->low > 780, longest);
  QVERIFY(w.idle());
  QVERIFY(w.segment(0).range->high > 780);
  QCOMPARE(w.voxels(2), voxelsWhere(isBright));
}

void TestCurveFollowed::whatIsChangedByHandIsLetGo_data() {
  QTest::addColumn<QString>("act");
  for (const char* act : {"a step", "a stroke", "other values", "the box"}) QTest::newRow(act) << act;
}

void TestCurveFollowed::whatIsChangedByHandIsLetGo() {
  QFETCH(QString, act);
  AxisWindow w;
  QVERIFY(w.makeBound(300));
  auto* box = w.child<QCheckBox>("segmentFollows");
  QVERIFY(box->isChecked());
  const QPoint at = w.showPlace(inShell);
  const Workspace there = w.workspace();
  if (act == QStringLiteral("a step")) QVERIFY(w.step("shrink"));
  if (act == QStringLiteral("a stroke")) {
    w.child<QAction>("paintTool")->trigger();
    QTest::mousePress(w.view(), Qt::LeftButton, Qt::ControlModifier, at);
    QTest::mouseRelease(w.view(), Qt::LeftButton, Qt::ControlModifier, at);
  }
  if (act == QStringLiteral("other values")) QVERIFY(w.make(400, 600, "segmentReplace"));
  if (act == QStringLiteral("the box")) QVERIFY(w.press("segmentFollows"));
  QVERIFY(w.idle());
  QVERIFY(w.workspace() != there);
  QVERIFY(!w.current().span && !box->isChecked() && !isItalic(w));
  const SegmentMap changed = *w.map();
  const int steps = w.steps();
  w.pull(0, 560);
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);  // step of the curve
  QVERIFY(*w.map() == changed);
  w.undo();
  w.undo();
  QVERIFY(w.idle());
  QVERIFY(w.workspace() == there);
  QVERIFY(w.current().span && box->isChecked() && isItalic(w));
}

// A change that takes no voxel of a segment leaves it bound.
void TestCurveFollowed::anotherOneMayBeChanged() {
  AxisWindow w;
  QVERIFY(w.makeBound(700));
  QVERIFY(w.make(450, 550));
  QVERIFY(w.step("shrink"));
  QVERIFY((w.segment(0).span == CurveSpan{0, 1}));
  QVERIFY(w.make(900, 1100, "segmentReplace"));  // the second takes all voxels of the first
  QCOMPARE(w.voxels(1), 0);
  QVERIFY(!w.segment(0).span);
}

void TestCurveFollowed::aLockedOneStays() {
  AxisWindow w;
  QVERIFY(w.makeBound(300));
  w.tick(0, 1);
  QVERIFY(w.current().locked && !w.child<QCheckBox>("segmentFollows")->isEnabled());
  const SegmentMap locked = *w.map();
  w.pull(0, 560);
  QVERIFY(w.idle());
  QVERIFY(*w.map() == locked);
  w.tick(0, 1);
  w.pull(0, 600);
  QTRY_COMPARE_WITH_TIMEOUT(w.voxels(1), voxelsWhere(isBright), longest);
}

void TestCurveFollowed::itWaitsWhileTheCurveShowsOtherSpans() {
  AxisWindow w;
  QVERIFY(w.makeBound(300));
  w.session().edit(QStringLiteral("test"), [](Scene& s) {
    const CurvePoint none{100, {1, 1, 1}, 0.0}, some{150, {1, 1, 1}, 0.5}, again{200, {1, 1, 1}, 0.0};
    auto& points = s.transferFunction.points;
    points.insert(points.begin(), {none, some, again});
  });
  w.session().endGesture();
  const SegmentMap before = *w.map();
  w.pull(3, 560);
  QVERIFY(w.idle());
  QVERIFY(*w.map() == before);
  w.setFoot(300);
  w.pull(0, 560);
  QTRY_COMPARE_WITH_TIMEOUT(w.voxels(1), voxelsWhere(isBright), longest);
}

void TestCurveFollowed::undoneMeanwhileItStays() {
  AxisWindow w;
  QVERIFY(w.makeBound(300));
  const Workspace before = w.workspace();
  w.pull(0, 560);
  w.undo();  // before the job is done
  QVERIFY(w.workspace() == before);
  QVERIFY(w.idle());
  QCoreApplication::processEvents();
  QVERIFY(w.workspace() == before);
  QVERIFY(w.session().undoStack().canRedo());
}

void TestCurveFollowed::whatIsDoneMeanwhileIsWaitedFor_data() {
  QTest::addColumn<QString>("act");
  for (const char* act : {"a stroke", "a stroke that is given up", "another segment"})
    QTest::newRow(act) << act;
}

// The curve was moved just before, and its job ends while the stroke is being drawn.
void TestCurveFollowed::whatIsDoneMeanwhileIsWaitedFor() {
  QFETCH(QString, act);
  const bool isGivenUp = act.endsWith(QStringLiteral("given up"));
  AxisWindow w;
  QVERIFY(w.makeBound(300) && w.press("segmentAdd"));
  w.child<QAction>("paintTool")->trigger();
  const QPoint at = w.showPlace({10, -10, -10});
  const Workspace before = w.workspace();
  const int steps = w.steps();
  w.pull(0, 560);
  if (act == QStringLiteral("another segment")) {
    w.click("segmentAdd");
    QVERIFY2(w.voxels(1) == voxelsWhere(isAnyBall), "the job is not back yet");
  } else {
    QTest::mousePress(w.view(), Qt::LeftButton, {}, at);
    QVERIFY(w.idle());
    QVERIFY2(w.voxels(1) == voxelsWhere(isAnyBall), "nothing becomes a step in the middle of a stroke");
    QVERIFY(w.voxels(2) > 0);
    if (isGivenUp) QTest::keyClick(w.view(), Qt::Key_Escape);
    QTest::mouseRelease(w.view(), Qt::LeftButton, {}, at);
  }
  QTRY_COMPARE_WITH_TIMEOUT(w.voxels(1), voxelsWhere(isBright), longest);
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + (isGivenUp ? 1 : 2));
  QCOMPARE(w.count(), std::size_t(act == QStringLiteral("another segment") ? 3 : 2));
  QCOMPARE(w.voxels(2) > 0, act == QStringLiteral("a stroke"));
  while (w.steps() > steps) w.undo();
  QVERIFY(w.idle());
  QVERIFY(w.isAs(before));
}

VOLUMEN_TEST(TestCurveFollowed);
#include "tst_curve_followed.moc"
