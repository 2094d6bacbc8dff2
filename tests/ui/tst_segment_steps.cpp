// Guards changes of a segment's voxels: each recipe step of the panel is one job and one undo step. Covers
// locks, cancelling and series closed meanwhile. Long random sequences are undone and redone.
#include <QComboBox>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/controller/offered_steps.h"
#include "ui/widgets/banner.h"
#include "viewer/segment/morphology.h"
#include "viewer/segment/parts.h"
#include "viewer/segment/smoothing.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentSteps : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theUsualOnesAreAClick();
  void aWordOfAnotherKindIsNotTaken();
  void aReversedRangeIsNotTaken();
  void partsBecomeSegments();
  void allAreSmoothedTogether();
  void theFewThatAreKnownInClosedForm();
  void whatIsAskedForMeanwhileWaits();
  void lockedSegmentsStayAsTheyAre();
  void whatWasLockedMeanwhileLosesNothing_data();
  void whatWasLockedMeanwhileLosesNothing();
  void aJobThatIsCancelledChangesNothing();
  void aSeriesThatIsClosedMeanwhileIsLeftAlone();
  void aSegmentThatIsUndoneMeanwhileIsLeftAlone();
  void sequencesAreUndoneAndDoneAgain_data();
  void sequencesAreUndoneAndDoneAgain();
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

// The result is that of the kernel for all labels at once.
void TestSegmentSteps::allAreSmoothedTogether() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  w.tick(1, 1);
  QVERIFY(w.choose(0));
  const LabelMap before = *w.map()->labels;
  w.chooseStep("joint");
  w.setField("sigmaMm", 1.5);
  const int steps = w.steps();
  QVERIFY(w.press("segmentApply"));
  QCOMPARE(w.steps(), steps + 1);
  const std::uint8_t locked[] = {2};
  QVERIFY(*w.map()->labels == jointSmoothed(before, 1.5, locked));
  QVERIFY(*w.map()->labels != before);
}

void TestSegmentSteps::theFewThatAreKnownInClosedForm() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  const auto whole = [](glm::dvec3 p) { return glm::length(p + 5.0) < 10; };
  QCOMPARE(w.voxels(1), voxelsWhere([](glm::dvec3 p) { return isShell(p) || isSmall(p); }));
  QCOMPARE(w.voxels(2), voxelsWhere(isCore));
  QVERIFY(w.step("largest"));
  QCOMPARE(w.voxels(1), voxelsWhere(isShell));
  QVERIFY(w.step("fill"));
  QCOMPARE(w.voxels(1), voxelsWhere(whole));
  QCOMPARE(w.voxels(2), std::int64_t(0));
  QVERIFY(w.step("invert"));
  QCOMPARE(w.voxels(1), std::int64_t(40 * 40 * 40) - voxelsWhere(whole));
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

void TestSegmentSteps::whatWasLockedMeanwhileLosesNothing_data() {
  QTest::addColumn<std::string>("step");
  QTest::addColumn<int>("locked");
  QTest::newRow("merged into") << std::string("merge") << 1;
  QTest::newRow("merged") << std::string("merge") << 2;
  QTest::newRow("split") << std::string("split") << 1;
}

// The segment is locked while a job runs.
void TestSegmentSteps::whatWasLockedMeanwhileLosesNothing() {
  QFETCH(std::string, step);
  QFETCH(int, locked);
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  std::map<std::string, StepValue> fields;
  if (step == "merge") fields["other"] = std::string("2");
  const SegmentWork work = workOf(offeredStep(step), fields, w.session());
  SegmentMap map = *w.map();
  QVERIFY(work.makeAll(map, {}).ok());
  map.segments[std::size_t(locked - 1)].locked = true;
  const auto made = work.makeAll(map, {});
  QVERIFY(!made);
  QVERIFY(QString::fromStdString(made.message()).contains(QStringLiteral("is locked")));
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

void TestSegmentSteps::aSeriesThatIsClosedMeanwhileIsLeftAlone() {
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  const Workspace before = w.workspace();
  const SegmentMap map = *w.map();
  w.click("segmentStep-grow");
  w.click("segmentStep-shrink");
  w.session().close({map.series});
  QVERIFY(w.idle());
  QTest::qWait(50);
  QVERIFY(w.workspace().segmentMaps.empty());
  w.undo();
  QVERIFY(w.workspace() == before);
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

void TestSegmentSteps::sequencesAreUndoneAndDoneAgain_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(1, 5);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

// Does 200 acts in the panel. After each the segments are valid, and undo and redo lead through all of them.
void TestSegmentSteps::sequencesAreUndoneAndDoneAgain() {
  QFETCH(int, seed);
  constexpr int acts = 200;
  Chance chance{std::uint64_t(seed)};
  SegmentWindow w;
  w.chooseStep("islands");
  w.setField("leastMl", 0.2);
  const int first = w.steps();
  std::vector<Workspace> states{w.workspace()};
  for (int n = 0; n < acts; ++n) {
    const int row = chance.below(std::max(1, int(w.count())));
    const int column = chance.below(2);
    const bool on = chance.oneIn(3);
    const double low = chance.below(1000), high = chance.below(1200);
    switch (const int act = chance.below(10); w.count() == 0 ? 0 : act) {
      case 0:
        QVERIFY(w.make(low, high));
        break;
      case 1:
        QVERIFY(w.press(chance.oneIn(2) ? "segmentAdd" : "segmentDuplicate"));
        break;
      case 2:
        if (w.count() > 2) QVERIFY(w.press("segmentRemove"));
        break;
      case 3:
        w.list()->topLevelItem(row)->setCheckState(column, on ? Qt::Checked : Qt::Unchecked);
        break;
      case 4:
        w.list()->setCurrentItem(w.list()->topLevelItem(row));
        break;
      case 5:
        QVERIFY(w.make(low, high, "segmentReplace"));
        break;
      default: {
        const auto all = offeredSteps();
        QVERIFY(w.step(all[std::size_t(chance.below(int(all.size())))].name));
      }
    }
    QVERIFY(w.idle());
    const int index = w.steps() - first;
    QVERIFY2(index <= int(states.size()), "one step at most");
    if (index == int(states.size())) states.push_back(w.workspace());
    QVERIFY(w.workspace() == states[std::size_t(index)]);
    if (!w.map()) continue;
    for (int k = 0; k < 40; k += 7)
      for (int i = 0; i < 40; ++i) {
        const int label = w.map()->labels->at({i, (3 * i + k) % 40, k});
        QVERIFY(label == 0 || findSegment(*w.map(), label));
      }
  }
  QVERIFY2(states.size() > 40, qPrintable(QString::number(states.size())));
  for (int n = int(states.size()) - 1; n-- > 0;) {
    w.undo();
    QVERIFY2(w.workspace() == states[std::size_t(n)], qPrintable(QString::number(n)));
  }
  for (std::size_t n = 1; n < states.size(); ++n) {
    w.redo();
    QVERIFY2(w.workspace() == states[n], qPrintable(QString::number(n)));
  }
  QVERIFY(w.idle());
}

VOLUMEN_TEST(TestSegmentSteps);
#include "tst_segment_steps.moc"
