// Guards the messages about segment changes: the range, the segments that lost voxels, the painted segment,
// and why a tool is grey. Real events.
#include <QLabel>

#include "tests/ui/cut_window.h"
#include "tests/ui/session_folder.h"
#include "tests/unit/suite.h"
#include "ui/workspace/curve_spans.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentTargets : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aSessionOffersTheSpanOfItsCurve();
  void whatAnotherSegmentLosesIsSaid_data();
  void whatAnotherSegmentLosesIsSaid();
  void hiddenSegmentsAreNotPaintedInto();
  void changesOfHiddenSegmentsAreSaid();
  void aTickChoosesNoSegment();
  void greyToolsSayWhy();
  void whatWasNotCutIsForgottenOnceItIs();
};

namespace {

QString told(Journey& w) { return w.child<QLabel>("toldText")->text(); }

}  // namespace

void TestSegmentTargets::aSessionOffersTheSpanOfItsCurve() {
  const SessionFolder folder;
  {
    SegmentWindow w({folder.ct()});
    QVERIFY(w.settle());
    w.child<QDockWidget>("segmentDock")->raise();
    QVERIFY(w.press("segment") && w.count() == 1);
    QVERIFY(folder.save(w));
  }
  SegmentWindow w{QStringList()};
  QVERIFY(folder.open(w));
  QTRY_VERIFY_WITH_TIMEOUT(w.session().series() && w.count() == 1, longest);
  const auto span = rangeOfSpan(w.session().scene().transferFunction, 0, *w.session().series());
  QVERIFY(span && span->low < span->high);
  QVERIFY(std::abs(w.child<QDoubleSpinBox>("segmentLow")->value() - span->low) < 0.1);
  QVERIFY(std::abs(w.child<QDoubleSpinBox>("segmentHigh")->value() - span->high) < 0.1);
}

void TestSegmentTargets::whatAnotherSegmentLosesIsSaid_data() {
  QTest::addColumn<bool>("painted");
  QTest::newRow("by a range of values") << false;
  QTest::newRow("by a stroke") << true;
}

void TestSegmentTargets::whatAnotherSegmentLosesIsSaid() {
  QFETCH(bool, painted);
  PaintWindow w;
  QVERIFY(w.makeBoth());
  QVERIFY2(!told(w).contains(QStringLiteral("took")), "nothing was taken so far");
  w.show(throughMiddle());
  const std::int64_t core = w.voxels(2);
  if (painted) {
    w.take("paintTool");
    w.stroke(w.pixelsOf(throughBall, axialViewId));
  } else {
    QVERIFY(w.make(400, 1200));
  }
  const std::int64_t taken = core - w.voxels(2);
  QVERIFY(taken > 0);
  const QString amount =
      QStringLiteral("%1 voxels (%2 ml)").arg(taken).arg(QString::number(double(taken) / 1000, 'g', 3));
  QVERIFY2(told(w).contains(QStringLiteral("took")) && told(w).contains(amount) &&
               told(w).contains(QString::fromStdString(w.segment(1).label)),
           qPrintable(told(w)));
}

void TestSegmentTargets::hiddenSegmentsAreNotPaintedInto() {
  PaintWindow w;
  QVERIFY(w.makeBoth());
  w.show(throughMiddle());
  w.tick(0, 0);
  QVERIFY(!w.current().visible);
  w.take("paintTool");
  const Workspace before = w.workspace();
  w.stroke(w.pixelsOf(throughBall, axialViewId));
  QVERIFY(w.isAs(before));
  QVERIFY2(w.said().contains(QStringLiteral("is hidden")), qPrintable(w.said()));
  w.tick(0, 0);
  QVERIFY2(w.child<Banner>("banner")->isHidden(), "it can be painted now");
  w.stroke(w.pixelsOf(throughBall, axialViewId));
  QVERIFY(!w.isAs(before));
}

void TestSegmentTargets::changesOfHiddenSegmentsAreSaid() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  w.tick(0, 0);
  QVERIFY(w.step("grow"));
  QVERIFY2(told(w).contains(QStringLiteral("is hidden")), qPrintable(told(w)));
}

void TestSegmentTargets::aTickChoosesNoSegment() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  const int current = w.current().number, steps = w.steps();
  w.tick(1, 0);
  QVERIFY(!w.segment(1).visible);
  QCOMPARE(w.current().number, current);
  QCOMPARE(w.list()->currentIndex().row(), 0);
  QCOMPARE(w.steps(), steps + 1);
  w.tick(1, 0);
  QVERIFY(w.segment(1).visible && w.current().number == current);
}

void TestSegmentTargets::greyToolsSayWhy() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  w.session().setFocus(sceneViewId);
  for (const char* tool : {"segmentBrush", "segmentOutline"}) {
    QVERIFY(!w.button(tool)->isEnabled());
    QVERIFY2(w.button(tool)->toolTip().contains(QStringLiteral("click a view of slices")), tool);
  }
  w.session().setFocus(axialViewId);
  QVERIFY(w.button("segmentBrush")->isEnabled());
  QVERIFY(!w.button("segmentBrush")->toolTip().contains(QStringLiteral("click a view")));
}

void TestSegmentTargets::whatWasNotCutIsForgottenOnceItIs() {
  CutWindow w;
  QVERIFY(w.begin());
  auto* banner = w.child<Banner>("banner");
  w.drawIn(w.scene(), outlineAt({30, 30}, 8), {});
  QVERIFY(w.idle());
  QVERIFY2(w.said().startsWith(QStringLiteral("Nothing of the current segment was cut away")),
           qPrintable(w.said()));
  QVERIFY(banner->isVisible());
  const int steps = w.steps();
  w.drawIn(w.scene(), outlineAt(w.scenePixel({-9, -5, -5}), 40), {});
  QVERIFY(w.idle() && w.steps() == steps + 1);
  QVERIFY2(banner->isHidden(), "it was cut");
}

VOLUMEN_TEST(TestSegmentTargets);
#include "tst_segment_targets.moc"
