// Guards changes of a segment's voxels in the panel: what it offers, locks, cancelling and jobs that wait.
#include <QComboBox>

#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"
#include "viewer/segment/morphology.h"
#include "viewer/segment/parts.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentSteps : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theUsualOnesAreAClick();
  void aWordOfAnotherKindIsNotTaken();
  void aReversedRangeIsNotTaken();
  void partsBecomeSegments();
  void whatIsAskedForMeanwhileWaits();
  void lockedSegmentsStayAsTheyAre();
  void aJobThatIsCancelledChangesNothing();
  void aSegmentThatIsUndoneMeanwhileIsLeftAlone();
};

// The buttons use the numbers in their texts, which are those of the list.
void TestSegmentSteps::theUsualOnesAreAClick() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  const BitMask own = w.mask(1);
  w.chooseStep("grow");
  w.setField("radiusMm", 2);
  QCOMPARE(w.button("segmentStep-grow")->text(), QStringLiteral("Grow 2 mm"));
  QVERIFY(w.press("segmentStep-shrink"));
  QVERIFY(w.mask(1) == shrunk(own, 2));
  QCOMPARE(w.child<QComboBox>("segmentStepKind")->currentText(), QStringLiteral("Shrink"));
}

// Both steps have a field "across", but only one accepts the volume.
void TestSegmentSteps::aWordOfAnotherKindIsNotTaken() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  w.chooseStep("fill");
  auto* across = w.child<QComboBox>("stepField-across");
  across->setCurrentIndex(across->findText(QStringLiteral("volume")));
  Q_EMIT across->activated(across->currentIndex());
  QVERIFY(w.step("betweenSlices"));
  QVERIFY(std::ranges::count(w.map()->steps, "betweenSlices", &Step::kind) == 1);
  const auto again = readSteps(stepsJson(w.map()->steps));
  QVERIFY2(again, again ? "" : again.message().c_str());
  QVERIFY(*again == w.map()->steps);
}

// A recipe cannot store a reversed range.
void TestSegmentSteps::aReversedRangeIsNotTaken() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  w.chooseStep("range");
  w.setField("low", 500);
  w.setField("high", 400);
  const QAbstractButton* apply = w.button("segmentApply");
  QVERIFY(!apply->isEnabled() && apply->toolTip().contains(QStringLiteral("ends below where it begins")));
  w.setField("high", 500);
  QVERIFY(apply->isEnabled());
}

void TestSegmentSteps::partsBecomeSegments() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  const Workspace before = w.workspace();
  const int steps = w.steps();
  w.chooseStep("split");
  QVERIFY(w.press("segmentApply"));
  QCOMPARE(w.steps(), steps + 1);
  QCOMPARE(w.count(), std::size_t(3));
  QCOMPARE(w.current().number, 1);
  QCOMPARE(w.voxels(1), voxelsWhere(isShell));
  QCOMPARE(w.voxels(3), voxelsWhere(isSmall));
  // The segment now has one component.
  QVERIFY(w.press("segmentApply"));
  QVERIFY(w.child<Banner>("banner")->sentence().contains(QStringLiteral("no second part")));
  // Merging restores the segment and removes the other one.
  w.chooseStep("merge");
  auto* other = w.child<QComboBox>("stepField-other");
  other->setCurrentIndex(other->findData(QStringLiteral("3")));
  Q_EMIT other->activated(other->currentIndex());
  QVERIFY(w.press("segmentApply"));
  QCOMPARE(w.count(), std::size_t(2));
  QVERIFY(*w.map()->labels == *before.segmentMaps.front().labels);
  w.undo(), w.undo();
  QVERIFY(w.workspace() == before);
}

void TestSegmentSteps::whatIsAskedForMeanwhileWaits() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  const BitMask own = w.mask(1);
  const int steps = w.steps();
  w.click("segmentChange");
  w.click("segmentStep-largest");
  w.click("segmentStep-grow");
  w.click("segmentStep-shrink");
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 3);
  QVERIFY(w.mask(1) == shrunk(grown(Parts(own, Neighbours::faces).largest(), 1), 1));
}

void TestSegmentSteps::lockedSegmentsStayAsTheyAre() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  const BitMask core = w.mask(2);
  w.tick(1, 1);
  QVERIFY(w.segment(1).locked && w.choose(0));
  for (const char* step : {"largest", "fill", "grow", "invert", "close"}) {
    QVERIFY(w.step(step));
    QVERIFY2(w.mask(2) == core, step);
    QVERIFY2(intersected(w.mask(1), core).empty(), step);
  }
  QVERIFY(w.make(-10, 2000));  // all values
  QVERIFY(w.mask(2) == core);
  QCOMPARE(w.voxels(3), std::int64_t(40 * 40 * 40) - core.count());
  // A locked segment itself does not change either.
  QVERIFY(w.choose(1));
  QVERIFY(!w.button("segmentStep-grow")->isEnabled());
  w.child<QAction>("partTool")->trigger();
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, w.showPlace(inSmallBall));
  QVERIFY(w.idle());
  QVERIFY(w.mask(2) == core);
  QVERIFY(w.child<Banner>("banner")->sentence().contains(QStringLiteral("is locked")));
}

void TestSegmentSteps::aJobThatIsCancelledChangesNothing() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  const Workspace before = w.workspace();
  const int steps = w.steps();
  w.click("segmentStep-grow");
  QCOMPARE(w.window.jobs().rows().size(), std::size_t(1));
  QVERIFY(w.window.jobs().rows().front().canBeCancelled);
  w.window.jobs().cancel(w.window.jobs().rows().front().id);
  QVERIFY(w.idle());
  QTest::qWait(50);
  QVERIFY(w.workspace() == before && w.steps() == steps);
  // The next step is done.
  QVERIFY(w.step("shrink"));
  QCOMPARE(w.steps(), steps + 1);
}

void TestSegmentSteps::aSegmentThatIsUndoneMeanwhileIsLeftAlone() {
  SegmentWindow w;
  QVERIFY(w.make(800, 1200));
  w.click("segmentStep-grow");
  w.undo();
  QVERIFY(w.idle());
  QTest::qWait(50);
  QVERIFY(w.workspace().segmentMaps.empty());
  QVERIFY(w.child<Banner>("banner")->sentence().isEmpty());
}

VOLUMEN_TEST(TestSegmentSteps);
#include "tst_segment_steps.moc"
