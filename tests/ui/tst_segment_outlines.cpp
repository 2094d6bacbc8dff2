// Guards outlines in slices, drawn by a drag or clicks, painted and erased, and interpolation between painted
// slices.
#include "tests/ui/paint_window.h"
#include "tests/unit/suite.h"
#include "viewer/segment/between_slices.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentOutlines : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void outlinesAreSteps_data();
  void outlinesAreSteps();
  void outlinesThatAreNone();
  void slicesBetweenPaintedOnesAreFilled();
};

void TestSegmentOutlines::outlinesAreSteps_data() {
  QTest::addColumn<QString>("how");
  QTest::addColumn<bool>("erases");
  QTest::addColumn<bool>("oblique");
  QTest::newRow("drag") << QStringLiteral("drag") << false << false;
  QTest::newRow("clicks, Enter") << QStringLiteral("Enter") << false << false;
  QTest::newRow("clicks, double-click") << QStringLiteral("double") << false << false;
  QTest::newRow("clicks, one taken back") << QStringLiteral("Backspace") << false << false;
  QTest::newRow("drag, oblique") << QStringLiteral("drag") << false << true;
  QTest::newRow("clicks, oblique") << QStringLiteral("Enter") << false << true;
  QTest::newRow("drag, erases") << QStringLiteral("drag") << true << false;
  QTest::newRow("clicks, erase") << QStringLiteral("Enter") << true << false;
}

void TestSegmentOutlines::outlinesAreSteps() {
  QFETCH(QString, how);
  QFETCH(bool, erases);
  QFETCH(bool, oblique);
  PaintWindow w;
  QVERIFY(w.make(800, 1200));
  w.show(oblique ? obliquely() : throughMiddle());
  const BitMask own = w.mask(1);
  const Workspace before = w.workspace();
  const int steps = w.steps();
  const Qt::KeyboardModifiers keys = erases ? Qt::ControlModifier : Qt::NoModifier;
  w.take("outlineTool");
  const QPoint middle = w.pixelOf(glm::dvec3(-5), axialViewId);
  const std::vector<QPoint> corners{middle - QPoint(70, 60), middle + QPoint(50, -66), middle + QPoint(8, 3),
                                    middle + QPoint(64, 58), middle + QPoint(-59, 71)};
  if (how == QStringLiteral("drag")) {
    w.stroke(corners, axialViewId, keys);
  } else {
    for (const QPoint corner : corners) {
      QTest::mouseClick(w.view(), Qt::LeftButton, keys, corner);
      if (how == QStringLiteral("Backspace") && corner == corners[2]) {
        QTest::mouseClick(w.view(), Qt::LeftButton, keys, middle + QPoint(90, 0));
        QTest::keyClick(w.view(), Qt::Key_Backspace);
      }
      QVERIFY2(w.workspace() == before, "not closed yet");
      if (corner != corners[0]) QCOMPARE(w.view()->drawnMeasurements().size(), std::size_t(1));
    }
    if (how == QStringLiteral("double"))
      QTest::mouseDClick(w.view(), Qt::LeftButton, keys, corners.back());
    else
      QTest::keyClick(w.view(), Qt::Key_Return);
  }
  const BitMask inside = w.insideOf(corners);
  QVERIFY(inside.count() > 50);
  QCOMPARE(w.steps(), steps + 1);
  QVERIFY(w.mask(1) == (erases ? subtracted(own, inside) : united(own, inside)));
  QVERIFY(w.mask(1) != own);
  QVERIFY(w.view()->drawnMeasurements().empty() && w.all().empty());
  QCOMPARE(&w.inHand(), &toolNamed("outline"));
  QVERIFY(w.idle());
  const Workspace after = w.workspace();
  w.undo();
  QVERIFY(w.workspace() == before);
  w.redo();
  QVERIFY(w.workspace() == after);
}

void TestSegmentOutlines::outlinesThatAreNone() {
  PaintWindow w;
  w.take("outlineTool");
  const Workspace before = w.workspace();
  const QPoint at = w.view()->rect().center();
  const auto click = [&](QPoint p) { QTest::mouseClick(w.view(), Qt::LeftButton, {}, p); };
  click(at), click(at + QPoint(50, 0));
  QTest::keyClick(w.view(), Qt::Key_Return);
  QVERIFY2(w.workspace() == before && w.view()->drawnMeasurements().empty(), "two points");
  click(at), click(at + QPoint(50, 0)), click(at + QPoint(50, 50)), click(at + QPoint(0, 50));
  QTest::keyClick(w.view(), Qt::Key_Down);
  QVERIFY2(w.workspace() == before, "the slice stays under it");
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QVERIFY2(w.workspace() == before && w.view()->drawnMeasurements().empty(), "Esc");
  QCOMPARE(&w.inHand(), &toolNamed("outline"));
  w.press(at);
  w.move(at + QPoint(50, 0)), w.move(at + QPoint(50, 50));
  QTest::keyClick(w.view(), Qt::Key_Escape);
  w.release(at + QPoint(50, 50));
  QVERIFY2(w.workspace() == before, "Esc in a drag");
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QVERIFY(&w.inHand() != &toolNamed("outline"));
}

void TestSegmentOutlines::slicesBetweenPaintedOnesAreFilled() {
  PaintWindow w;
  w.take("paintTool");
  for (const double z : {-8.5, -0.5}) {
    Crosshair crosshair = throughMiddle();
    crosshair.at.z = z;
    w.show(crosshair);
    w.stroke(w.pixelsOf({{z, 0, z}}, axialViewId));
  }
  const BitMask two = w.mask(1);
  const Workspace before = w.workspace();
  const int steps = w.steps();
  w.click("segmentPaint");
  w.click("segmentFillBetween");
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  QCOMPARE(axisOfPaintedSlices(two), std::optional(2));
  QVERIFY(w.mask(1) == filledBetweenSlices(two, 2));
  QVERIFY(w.mask(1) != two);
  w.click("segmentFillBetween");
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  QVERIFY(w.said().contains(QStringLiteral("no empty slices")));
  w.undo();
  QVERIFY(w.workspace() == before);
}

VOLUMEN_TEST(TestSegmentOutlines);
#include "tst_segment_outlines.moc"
