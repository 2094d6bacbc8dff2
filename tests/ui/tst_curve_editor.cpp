// Guards design.md 8 (curve editor) and picture.md 4 (opacity per unitDistance, extinction).
#include <QSignalSpy>
#include <QWheelEvent>
#include <cmath>

#include "tests/ui/gestures.h"
#include "tests/unit/suite.h"
#include "ui/widgets/axes.h"
#include "ui/widgets/curve_editor.h"
#include "viewer/scene/curve_edits.h"

using namespace volumen;

namespace {

// Returns a CT-like curve of three points over -1000..3000 HU.
TransferFunction threePoints() {
  TransferFunction curve;
  curve.points = {{0, {1, 0, 0}, 0.0}, {1000, {0, 1, 0}, 0.5}, {2000, {0, 0, 1}, 0.9}};
  return curve;
}

struct Shown {
  CurveEditor editor;
  QSignalSpy edits{&editor, &CurveEditor::edited}, gestures{&editor, &CurveEditor::gestureFinished};

  explicit Shown(const TransferFunction& curve = threePoints()) {
    Histogram histogram{.low = -1000, .high = 3000, .counts = std::vector<std::int64_t>(400, 10)};
    editor.resize(500, 300);
    editor.setHistogram(histogram, QStringLiteral("HU"));
    editor.setCurve(curve);
    editor.show();
    editor.setFocus();
  }
};

}  // namespace

class TestCurveEditor : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void opacityAndPixelAreInverse_data();
  void opacityAndPixelAreInverse();
  void extinctionAxisReachesSmallValues();
  void ticksAreRound_data();
  void ticksAreRound();
  void editsKeepTheCurveValid();
  void dragMovesAPoint();
  void dragStopsAtTheNeighbour();
  void shiftDragKeepsOneAxis();
  void dragSetsASmallExtinction();
  void doubleClickAddsAPointOnTheCurve();
  void rightClickAndDeleteRemove();
  void wheelZoomsAtTheCursor();
  void dragOnEmptyGroundPans();
  void tabWalksThePointsAndArrowsNudge();
  void swatchAsksForAColour();
  void valuesSnapToTissues();
};

void TestCurveEditor::opacityAndPixelAreInverse_data() {
  QTest::addColumn<bool>("extinction");
  QTest::addColumn<double>("unitDistance");
  QTest::addColumn<double>("opacity");
  for (bool extinction : {false, true})
    for (double unit : {1.0, 5.0})
      for (double opacity : {0.0, 0.0001, 0.01, 0.5, 0.99, 1.0})
        QTest::addRow("%s, per %g mm, %g", extinction ? "extinction" : "linear", unit, opacity)
            << extinction << unit << opacity;
}

void TestCurveEditor::opacityAndPixelAreInverse() {
  QFETCH(bool, extinction);
  QFETCH(double, unitDistance);
  QFETCH(double, opacity);
  const OpacityAxis axis{extinction ? OpacityScale::extinction : OpacityScale::linear, unitDistance, 200, 20};
  const double pixel = axis.pixelOf(opacity);
  QVERIFY(pixel <= 200 && pixel >= 20);
  // Only rounding remains, because the mapping is exact in real numbers.
  QVERIFY(std::abs(axis.opacityAt(pixel) - opacity) < 1e-9);
}

void TestCurveEditor::extinctionAxisReachesSmallValues() {
  const OpacityAxis axis{OpacityScale::extinction, 1, 200, 20};
  const double from = axis.pixelOf(opacityFromExtinction(1e-4, 1));
  const double to = axis.pixelOf(opacityFromExtinction(1e-2, 1));
  QVERIFY2(from - to > 50, "0.0001 and 0.01 per mm lie more than 50 of 180 pixels apart");
  QCOMPARE(axis.opacityAt(200), 0.0);
}

void TestCurveEditor::ticksAreRound_data() {
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  QTest::addColumn<int>("most");
  QTest::addColumn<QList<double>>("ticks");
  using List = QList<double>;
  QTest::newRow("hundreds") << -1000.0 << 1000.0 << 5 << List{-1000, -500, 0, 500, 1000};
  QTest::newRow("odd ends") << -1024.0 << 3071.0 << 5 << List{-1000, 0, 1000, 2000, 3000};
  QTest::newRow("small") << 0.0 << 0.01 << 6 << List{0, 0.002, 0.004, 0.006, 0.008, 0.01};
  QTest::newRow("nothing") << 1.0 << 1.0 << 5 << List{};
}

void TestCurveEditor::ticksAreRound() {
  QFETCH(double, low);
  QFETCH(double, high);
  QFETCH(int, most);
  QFETCH(QList<double>, ticks);
  const std::vector<double> found = roundTicks(low, high, most);
  QCOMPARE(found.size(), std::size_t(ticks.size()));
  for (std::size_t n = 0; n < found.size(); ++n) QVERIFY(std::abs(found[n] - ticks[n]) < 1e-9);
}

void TestCurveEditor::editsKeepTheCurveValid() {
  const TransferFunction curve = threePoints();
  QCOMPARE(curveAt(curve, 500).opacity, 0.25);
  QCOMPARE(curveAt(curve, -5000).opacity, 0.0);
  QCOMPARE(curveAt(curve, 5000).opacity, 0.9);
  QCOMPARE(shifted(curve, 10).points[1].value, 1010.f);
  QCOMPARE(widened(curve, 2).points[0].value, -1000.f);
  QCOMPARE(widened(curve, 2).points[2].value, 3000.f);
  const TransferFunction thinner = withOpacityScaled(curve, 0.5);
  QCOMPARE(thinner.points[0].opacity, 0.0);
  // Half the extinction: 1 - sqrt(1 - 0.5).
  QVERIFY(std::abs(thinner.points[1].opacity - (1 - std::sqrt(0.5))) < 1e-12);
  TransferFunction one = curve;
  for (int n = 0; n < 3; ++n) one = withPointRemoved(one, 0);
  QCOMPARE(one.points.size(), std::size_t(1));
}

void TestCurveEditor::dragMovesAPoint() {
  Shown shown;
  CurveEditor& e = shown.editor;
  const QPointF from = e.positionOf(1), to = from + QPointF(30, -40);
  tests::drag(&e, from, to);
  QCOMPARE(shown.edits.count(), 4);
  QCOMPARE(shown.gestures.count(), 1);
  QCOMPARE(e.selected(), 1);
  // The press and the release are rounded to pixels.
  const CurvePoint moved = e.curve().points[1];
  QVERIFY(std::abs(moved.value - (1000 + 30 * e.valueAxis().valuesPerPixel())) <
          1.01 * e.valueAxis().valuesPerPixel());
  QVERIFY(std::abs(moved.opacity - (0.5 + 40 / e.opacityAxis().pixelZero)) < 0.1);
  QVERIFY(moved.opacity > 0.6);
}

void TestCurveEditor::dragStopsAtTheNeighbour() {
  Shown shown;
  CurveEditor& e = shown.editor;
  tests::drag(&e, e.positionOf(1), e.positionOf(2) + QPointF(60, 0));
  QCOMPARE(e.curve().points[1].value, 2000.f);
  QCOMPARE(e.curve().points[2].value, 2000.f);
}

void TestCurveEditor::shiftDragKeepsOneAxis() {
  Shown shown;
  CurveEditor& e = shown.editor;
  tests::drag(&e, e.positionOf(1), e.positionOf(1) + QPointF(8, -40), Qt::LeftButton, Qt::ShiftModifier);
  QCOMPARE(e.curve().points[1].value, 1000.f);
  QVERIFY(e.curve().points[1].opacity > 0.6);
}

void TestCurveEditor::dragSetsASmallExtinction() {
  Shown shown;
  CurveEditor& e = shown.editor;
  e.setOpacityScale(OpacityScale::extinction);
  const QPointF to(e.positionOf(0).x() + 4, e.opacityAxis().pixelOf(opacityFromExtinction(0.002, 1)));
  tests::drag(&e, e.positionOf(0), to);
  const double extinction = extinctionPerMm(e.curve().points[0].opacity, 1);
  // One pixel is a factor of about 1.06 here. Two pixels of rounding are allowed.
  QVERIFY2(extinction > 0.002 / 1.15 && extinction < 0.002 * 1.15, qPrintable(QString::number(extinction)));
}

void TestCurveEditor::doubleClickAddsAPointOnTheCurve() {
  Shown shown;
  CurveEditor& e = shown.editor;
  const QPoint at(int(e.valueAxis().pixelOf(1500)), int(e.opacityAxis().pixelOf(0.2)));
  QTest::mouseDClick(&e, Qt::LeftButton, {}, at);
  QCOMPARE(e.curve().points.size(), std::size_t(4));
  QCOMPARE(e.selected(), 2);
  const CurvePoint added = e.curve().points[2];
  QVERIFY(std::abs(added.value - 1500) <= e.valueAxis().valuesPerPixel());
  QVERIFY(std::abs(added.opacity - 0.2) < 0.01);
  QVERIFY(std::abs(added.colour.z - 0.5) < 0.01);
}

void TestCurveEditor::rightClickAndDeleteRemove() {
  Shown shown;
  CurveEditor& e = shown.editor;
  QTest::mouseClick(&e, Qt::RightButton, {}, e.positionOf(1).toPoint());
  QCOMPARE(e.curve().points.size(), std::size_t(2));
  QTest::mouseClick(&e, Qt::LeftButton, {}, e.positionOf(1).toPoint());
  QTest::keyClick(&e, Qt::Key_Delete);
  QCOMPARE(e.curve().points.size(), std::size_t(1));
  e.select(0);
  QTest::keyClick(&e, Qt::Key_Delete);
  QCOMPARE(e.curve().points.size(), std::size_t(1));  // the last point stays
}

void TestCurveEditor::wheelZoomsAtTheCursor() {
  Shown shown;
  CurveEditor& e = shown.editor;
  const QPointF at(300, 100);
  const ValueAxis before = e.valueAxis();
  QWheelEvent wheel(at, e.mapToGlobal(at), {}, {0, 120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase,
                    false);
  QCoreApplication::sendEvent(&e, &wheel);
  const ValueAxis after = e.valueAxis();
  QVERIFY(std::abs(after.valueAt(300) - before.valueAt(300)) < 1e-6);
  QVERIFY(std::abs(after.valuesPerPixel() / before.valuesPerPixel() - 0.8) < 1e-9);
  QTest::keyClick(&e, Qt::Key_Home);
  QCOMPARE(e.valueAxis().low, before.low);
}

void TestCurveEditor::dragOnEmptyGroundPans() {
  Shown shown;
  CurveEditor& e = shown.editor;
  const double before = e.valueAxis().valueAt(200);
  tests::drag(&e, {200, 60}, {250, 60});
  QVERIFY(std::abs(e.valueAxis().valueAt(250) - before) < 1e-6);
  QCOMPARE(shown.edits.count(), 0);
}

void TestCurveEditor::tabWalksThePointsAndArrowsNudge() {
  Shown shown;
  CurveEditor& e = shown.editor;
  QTest::keyClick(&e, Qt::Key_Tab);
  QCOMPARE(e.selected(), 0);
  QTest::keyClick(&e, Qt::Key_Tab);
  QCOMPARE(e.selected(), 1);
  shown.gestures.clear();
  QTest::keyClick(&e, Qt::Key_Right);
  QCOMPARE(shown.gestures.count(), 1);
  const double step = e.curve().points[1].value - 1000.0;
  QVERIFY(step > 0);
  QTest::keyClick(&e, Qt::Key_Left);
  QTest::keyClick(&e, Qt::Key_Right, Qt::ShiftModifier);
  QVERIFY(std::abs((e.curve().points[1].value - 1000.0) - step / 10) < step / 100);
  QTest::keyClick(&e, Qt::Key_Up);
  QVERIFY(e.curve().points[1].opacity > 0.5);
}

void TestCurveEditor::swatchAsksForAColour() {
  Shown shown;
  QSignalSpy asked(&shown.editor, &CurveEditor::colourRequested);
  QTest::mouseClick(&shown.editor, Qt::LeftButton, {}, shown.editor.swatchOf(2).center().toPoint());
  QCOMPARE(asked.count(), 1);
  QCOMPARE(asked[0][0].toInt(), 2);
}

void TestCurveEditor::valuesSnapToTissues() {
  Shown shown;
  CurveEditor& e = shown.editor;
  tests::drag(&e, e.positionOf(0), QPointF(e.valueAxis().pixelOf(200) + 2, 150));
  QCOMPARE(e.curve().points[0].value, 200.f);  // contrast
}

VOLUMEN_TEST(TestCurveEditor);
#include "tst_curve_editor.moc"
