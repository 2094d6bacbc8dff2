// Guards design.md 11: the ends of a segment's range are dragged on the axis of the curve, by real events.
// Fields, slices and 3D follow, and the segment is made from the values of the fields.
#include <QComboBox>
#include <QSignalSpy>
#include <cmath>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/ui/axis_window.h"
#include "tests/unit/suite.h"
#include "viewer/scene/visible_range.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentCurve : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theFieldsFollowTheEnds_data();
  void theFieldsFollowTheEnds();
  void theEndsFollowTheFields();
  void anEndStopsAtTheOther();
  void linesAreDraggedAndPointsComeFirst();
  void theyStandThereWithThePage();
  void aProjectionHasThem();
  void nothingVisibleHasThem();
  void theyGoWithTheSeries();
  void slicesAnd3dFollow();
  void whatIsDraggedIsMade_data();
  void whatIsDraggedIsMade();
  void aLockedSegmentStays();
};

void TestSegmentCurve::theFieldsFollowTheEnds_data() {
  QTest::addColumn<bool>("pet");
  QTest::addColumn<double>("factor");
  QTest::newRow("HU") << false << 1.0;
  QTest::newRow("the axis in Bq/ml, the fields in SUV") << true << 0.005;
}

void TestSegmentCurve::theFieldsFollowTheEnds() {
  QFETCH(bool, pet);
  QFETCH(double, factor);
  AxisWindow w(ballsOf(pet));
  w.setFields(300 * factor, 700 * factor);
  const Workspace before = w.workspace();
  const int steps = w.steps();
  w.dragEnd(0, 555);
  QVERIFY(std::abs(w.field(0)->value() / factor - 555) < 1.5 * w.pixel());
  QCOMPARE(w.field(1)->value(), 700 * factor);
  QVERIFY(w.field(0)->hasFocus());
  w.dragEnd(1, 901);
  QVERIFY(std::abs(w.field(1)->value() / factor - 901) < 1.5 * w.pixel());
  QVERIFY(w.field(1)->hasFocus());
  // The values are those of the fields, without digits beyond their precision.
  QCOMPARE(w.ends(0), w.field(0)->value() / factor);
  QCOMPARE(w.ends(1), w.field(1)->value() / factor);
  QVERIFY(w.workspace() == before);
  QCOMPARE(w.steps(), steps);
}

void TestSegmentCurve::theEndsFollowTheFields() {
  AxisWindow w;
  w.setFields(200, 600);
  w.field(0)->setFocus();
  QTest::keyClick(w.field(0), Qt::Key_A, Qt::ControlModifier);
  QTest::keyClicks(w.field(0), QStringLiteral("444"));
  QCOMPARE(w.ends(0), 444.0);
  const auto pixelOf = [&](double value) { return w.curve()->valueAxis().pixelOf(value); };
  QCOMPARE(w.curve()->rangeHandle(0).right(), pixelOf(444));
  QCOMPARE(w.curve()->rangeHandle(1).left(), pixelOf(600));
  // If they are typed in reverse, the lower value is still the lower end.
  w.setFields(900, 100);
  QCOMPARE(w.ends(0), 100.0);
  QCOMPARE(w.ends(1), 900.0);
}

void TestSegmentCurve::anEndStopsAtTheOther() {
  AxisWindow w;
  w.setFields(300, 700);
  w.dragEnd(0, 1000);
  QCOMPARE(w.field(0)->value(), 700.0);
  QCOMPARE(w.field(1)->value(), 700.0);
  // Each end can be taken again.
  w.dragEnd(1, 900);
  QVERIFY(w.field(1)->value() > 850);
  QCOMPARE(w.field(0)->value(), 700.0);
  w.dragEnd(1, 100);
  QCOMPARE(w.field(1)->value(), 700.0);
  w.dragEnd(0, 200);
  QVERIFY(w.field(0)->value() < 250);
}

void TestSegmentCurve::linesAreDraggedAndPointsComeFirst() {
  AxisWindow w;
  w.session().edit(QStringLiteral("test"), [](Scene& s) {
    s.transferFunction.points = {{400, {1, 1, 1}, 0.0}, {600, {1, 1, 1}, 0.5}};
  });
  w.session().endGesture();
  w.setFields(400, 1000);
  // Drags on the line, halfway up.
  const QPointF onLine(w.curve()->valueAxis().pixelOf(1000), w.curve()->opacityAxis().pixelOf(0.7));
  tests::drag(w.curve(), onLine, onLine - QPointF(50, 0));
  QVERIFY(std::abs(w.field(1)->value() - (1000 - 50 * w.pixel())) < 1.5 * w.pixel());
  const TransferFunction curve = w.session().scene().transferFunction;
  QCOMPARE(curve.points.size(), std::size_t(2));
  // A double-click on a line adds no point.
  QTest::mouseDClick(w.curve(), Qt::LeftButton, {}, (onLine - QPointF(50, 0)).toPoint());
  QVERIFY(w.session().scene().transferFunction == curve);
  // The foot of the curve is at the lower end. A drag there moves the foot.
  tests::drag(w.curve(), w.curve()->positionOf(0), w.curve()->positionOf(0) - QPointF(40, 0));
  QVERIFY(w.session().scene().transferFunction.points[0].value < 400 - 20 * w.pixel());
}

void TestSegmentCurve::theyStandThereWithThePage() {
  AxisWindow w;
  QVERIFY(w.curve()->range());
  w.click("segmentPaint");
  QVERIFY(!w.curve()->range());
  w.click("segmentFromCurve");
  QVERIFY(w.curve()->range());
  w.child<QDockWidget>("segmentDock")->close();
  QVERIFY(!w.curve()->range());
  // The place of the line is empty background again.
  const double before = w.curve()->valueAxis().low;
  const QPointF at(w.curve()->valueAxis().pixelOf(1000), w.curve()->opacityAxis().pixelOf(0.7));
  tests::drag(w.curve(), at, at + QPointF(50, 0));
  QVERIFY(w.curve()->valueAxis().low < before);
}

// The axis of a projection shows the window, which stays unchanged.
void TestSegmentCurve::aProjectionHasThem() {
  AxisWindow w;
  w.session().edit(QStringLiteral("test"), [](Scene& s) { s.mode = Mode::mip, s.window = Window{600, 200}; });
  w.session().endGesture();
  w.curve()->showValues(-100, 1300);
  w.setFields(200, 1000);
  const Workspace before = w.workspace();
  w.dragEnd(0, 350);
  QVERIFY(std::abs(w.field(0)->value() - 350) < 1.5 * w.pixel());
  QVERIFY(w.workspace() == before);
}

void TestSegmentCurve::nothingVisibleHasThem() {
  AxisWindow w;
  w.setFields(200, 1000);
  w.session().edit(QStringLiteral("test"), [](Scene& s) {
    for (CurvePoint& p : s.transferFunction.points) p.opacity = 0;
  });
  QCOMPARE(w.child<QComboBox>("segmentSpans")->currentText(), QStringLiteral("Nothing is visible"));
  w.dragEnd(1, 800);
  QVERIFY(std::abs(w.field(1)->value() - 800) < 1.5 * w.pixel());
}

// Closing the series ends a drag.
void TestSegmentCurve::theyGoWithTheSeries() {
  AxisWindow w;
  w.setFields(300, 700);
  const QPointF from = w.flag(0), to = w.flagAt(0, 500);
  QTest::mousePress(w.curve(), Qt::LeftButton, {}, from.toPoint());
  QTest::mouseEvent(QTest::MouseMove, w.curve(), Qt::LeftButton, {}, to.toPoint());
  w.session().close({w.series()});
  QVERIFY(!w.curve()->range());
  QTest::mouseEvent(QTest::MouseMove, w.curve(), Qt::LeftButton, {}, from.toPoint());
  QTest::mouseRelease(w.curve(), Qt::LeftButton, {}, from.toPoint());
  QVERIFY(!w.curve()->range());
}

// During the drag slices are tinted, and 3D shows the part of the curve between the ends. Then 3D is as
// before.
void TestSegmentCurve::slicesAnd3dFollow() {
  AxisWindow w;
  std::optional<TransferFunction> seen;
  QObject::connect(w.window.view(), &VolumeView::drawn, w.window.view(),
                   [&](const ScreenPicture& picture) { seen = picture.scene.transferFunction; });
  const TransferFunction curve = w.session().scene().transferFunction;
  QTRY_VERIFY_WITH_TIMEOUT(!w.window.view()->picture().isNull(), longest);
  w.showPlace(inShell);
  w.setFields(900, 1100);
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  QTRY_COMPARE_WITH_TIMEOUT(w.coloured(), 0, longest);
  const QPointF from = w.flag(0), to = w.flagAt(0, 450);
  QTest::mousePress(w.curve(), Qt::LeftButton, {}, from.toPoint());
  QTest::mouseEvent(QTest::MouseMove, w.curve(), Qt::LeftButton, {}, ((from + to) / 2).toPoint());
  QTest::mouseEvent(QTest::MouseMove, w.curve(), Qt::LeftButton, {}, to.toPoint());
  const TransferFunction between = restrictedTo(curve, *w.curve()->range());
  QVERIFY(between != curve);
  QTRY_VERIFY_WITH_TIMEOUT(seen == between, longest);
  QTRY_VERIFY_WITH_TIMEOUT(w.coloured() > 100, longest);
  QVERIFY(w.session().scene().transferFunction == curve);
  w.shot("segment-curve-ends");
  QTest::mouseRelease(w.curve(), Qt::LeftButton, {}, to.toPoint());
  QTRY_VERIFY_WITH_TIMEOUT(seen == curve, longest);
  QVERIFY(w.coloured() > 100);  // the field has the keyboard focus
  w.view()->setFocus();
  QTRY_COMPARE_WITH_TIMEOUT(w.coloured(), 0, longest);
}

void TestSegmentCurve::whatIsDraggedIsMade_data() {
  QTest::addColumn<bool>("pet");
  QTest::newRow("CT") << false;
  QTest::newRow("PET") << true;
}

// Random drags are compared with a count of voxels, then undone.
void TestSegmentCurve::whatIsDraggedIsMade() {
  QFETCH(bool, pet);
  AxisWindow w(ballsOf(pet));
  const Workspace before = w.workspace();
  const Seeds seeds = seedsOf(4, 20);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{unsigned(seed)};
    w.setFields(pet ? 2.0 : 400, pet ? 3.0 : 600);
    for (int n = 0; n < 3; ++n) w.dragEnd(chance.below(2), -50 + chance.below(1300));
    const ValueRange range = *w.curve()->range();
    const auto count = voxelsWhere([&](glm::dvec3 p) {
      const double value = isCore(p) ? 500 : isShell(p) || isSmall(p) ? 1000 : 0;
      return value >= range.low && value <= range.high;
    });
    if (count == 0) continue;
    QVERIFY(w.press("segment"));
    QVERIFY(w.current().range == range);
    QVERIFY2(w.voxels(w.current().number) == count, qPrintable(QString::number(seed)));
    w.undo();
    QVERIFY(w.idle());
    QVERIFY(w.workspace() == before);
  }
}

void TestSegmentCurve::aLockedSegmentStays() {
  AxisWindow w;
  w.setFields(900, 1100);
  QVERIFY(w.press("segment"));
  w.tick(0, 1);
  QVERIFY(w.current().locked);
  const SegmentMap before = *w.map();
  w.dragEnd(0, 450);
  QVERIFY(!w.button("segmentReplace")->isEnabled());
  QVERIFY(*w.map() == before);
  QVERIFY(w.press("segment"));  // the shell stays its own
  QCOMPARE(w.voxels(1), voxelsWhere([](glm::dvec3 p) { return isShell(p) || isSmall(p); }));
  QCOMPARE(w.voxels(2), voxelsWhere(isCore));
}

VOLUMEN_TEST(TestSegmentCurve);
#include "tst_segment_curve.moc"
