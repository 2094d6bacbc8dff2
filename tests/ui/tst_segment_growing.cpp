// Guards growing from seeds in the window. Shown, unlocked segments are the seeds, and grow around them or
// everywhere. It is a job, one undo step and one recipe step. A preview follows the seeds. Covers locks,
// cancelling and series closed meanwhile.
#include <QCheckBox>
#include <QComboBox>

#include "results/segments/segment_record.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentGrowing : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void twoTissuesAreGrown_data();
  void twoTissuesAreGrown();
  void itIsAStepOfTheRecord_data();
  void itIsAStepOfTheRecord();
  void fewerThanTwoSeedsAreNotOffered();
  void hiddenAndLockedSegmentsStay();
  void thePreviewFollowsTheSeeds();
  void thePreviewEndsWithItsSeries();
  void aJobThatIsCancelledChangesNothing();
};

namespace {

constexpr glm::dvec3 ballMiddle(-5);

bool isInBall(glm::dvec3 p) { return glm::distance(p, ballMiddle) < 9; }

// Returns a ball of 1000 in 200, with special values at three positions, so that a range each selects the
// seeds.
LoadedSeriesPtr ballWithSeeds() {
  auto series = std::make_shared<LoadedSeries>(
      *seriesOf(volumeOf<std::int16_t>(glm::ivec3(40), glm::dmat3(1), [](glm::dvec3 pVoxel) {
        const glm::dvec3 p = pVoxel - 19.5;
        if (glm::distance(p, ballMiddle) < 1) return 1010.0;
        if (glm::distance(p, glm::dvec3(15)) < 1) return 210.0;
        if (glm::distance(p, glm::dvec3(10, -10, 10)) < 1) return 220.0;
        return isInBall(p) ? 1000.0 : 200.0;
      })));
  series->series.acquired = series->volume->geometry();
  series->firstScene.transferFunction.points = {{500, {1, 1, 1}, 0.0}, {500, {1, 1, 1}, 1.0}};
  return series;
}

struct GrowWindow : SegmentWindow {
  GrowWindow() : SegmentWindow(ballWithSeeds()) {}
  // Makes seed 1 inside the ball and seed 2 outside.
  bool makeSeeds() { return make(1005, 1015) && make(205, 215) && showPage(); }
  bool showPage() {
    click("segmentGrowing");
    return true;
  }
  void everywhere() { child<QComboBox>("growRegion")->setCurrentIndex(1); }
  bool grow() { return SegmentWindow::press("segmentGrow"); }
  void setPreview(bool on) {
    if (button("growPreview")->isChecked() != on) click("growPreview");
  }
  // Returns the colour of a position's pixel in the axial slice.
  QColor colourAt(glm::dvec3 p) {
    const glm::dvec2 pixel = view()->plane()->pixelFromPatient(p);
    return view()->picture().pixelColor(int(pixel.x), int(pixel.y));
  }
  bool isTintedAt(glm::dvec3 p) {
    const QColor c = colourAt(p);
    return c.red() != c.green() || c.green() != c.blue();
  }
};

}  // namespace

void TestSegmentGrowing::twoTissuesAreGrown_data() {
  QTest::addColumn<bool>("previewed");
  QTest::newRow("at once") << false;
  QTest::newRow("as it was previewed") << true;
}

void TestSegmentGrowing::twoTissuesAreGrown() {
  QFETCH(bool, previewed);
  GrowWindow w;
  QVERIFY(w.makeSeeds());
  w.everywhere();
  if (previewed) {
    w.setPreview(true);
    QVERIFY(w.idle());
  }
  const Workspace before = w.workspace();
  const int steps = w.steps();
  QVERIFY(w.grow());
  QCOMPARE(w.steps(), steps + 1);
  QCOMPARE(w.voxels(1), voxelsWhere(isInBall));
  QCOMPARE(w.voxels(2), std::int64_t(40 * 40 * 40) - voxelsWhere(isInBall));
  QVERIFY2(!w.button("growPreview")->isChecked(), "it has been taken");
  const Workspace after = w.workspace();
  w.undo();
  QVERIFY(w.workspace() == before);
  w.redo();
  QVERIFY(w.workspace() == after);
}

void TestSegmentGrowing::itIsAStepOfTheRecord_data() {
  QTest::addColumn<bool>("isEverywhere");
  QTest::addColumn<bool>("isCut");
  QTest::addColumn<bool>("isPainted");
  QTest::newRow("about the seeds") << false << false << false;
  QTest::newRow("everywhere") << true << false << false;
  QTest::newRow("in what the scissors left") << true << true << false;
  QTest::newRow("a seed was painted") << true << false << true;
}

// Its recipe makes the same voxels while a third segment is locked. If its initial state is no recipe step,
// everything that grew counts as manual.
void TestSegmentGrowing::itIsAStepOfTheRecord() {
  QFETCH(bool, isEverywhere);
  QFETCH(bool, isCut);
  QFETCH(bool, isPainted);
  GrowWindow w;
  QVERIFY(w.makeSeeds() && w.make(216, 225) && w.showPage());
  w.tick(2, 1);
  if (isEverywhere) w.everywhere();
  if (isCut) {
    Lasso lasso;
    lasso.points = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}};
    Mask mask;
    mask.lassos = {std::make_shared<const Lasso>(lasso)};
    w.session().setMask(QStringLiteral("test"), w.series(), mask);
  }
  if (isPainted)
    w.session().change(QStringLiteral("test"), [&](Workspace& after) {
      SegmentMap map = *w.map();
      BitMask painted = w.mask(1);
      painted.set({14, 14, 18});
      after = withSegmentMap(std::move(after), withMask(map, 1, painted));
    });
  QVERIFY(w.idle() && w.grow());
  const RecordedRecipe recorded = recordedRecipe(*w.map(), {});
  const std::size_t byHand = isCut || isPainted ? 2 : 0;
  QCOMPARE(recorded.missing.size(), byHand);
  QCOMPARE(recorded.recipe.segments.size(), 3 - byHand);
  if (byHand) return;
  QCOMPARE(std::ranges::count(w.map()->steps, "growFromSeeds", &Step::kind), 1);
  const auto again = readRecipe(recipeJson(recorded.recipe));
  QVERIFY2(again, again ? "" : again.message().c_str());
  const auto made = follow(*again, *w.session().series()->volume);
  QVERIFY2(made, made ? "" : made.message().c_str());
  QVERIFY(made->labels == *w.map()->labels);
}

void TestSegmentGrowing::fewerThanTwoSeedsAreNotOffered() {
  GrowWindow w;
  w.showPage();
  const auto isOffered = [&] { return w.button("segmentGrow")->isEnabled(); };
  QVERIFY(!isOffered() && !w.button("segmentGrow")->toolTip().isEmpty());
  QVERIFY(w.make(1005, 1015));
  QVERIFY(!isOffered());
  QVERIFY(w.make(205, 215));
  QVERIFY(isOffered());
  w.tick(1, 1);
  QVERIFY2(!isOffered(), "one is locked");
  w.tick(1, 1);
  w.tick(0, 0);
  QVERIFY2(!isOffered(), "one is hidden");
  w.tick(0, 0);
  QVERIFY(isOffered());
  // Reports that one of the two segments is empty.
  QVERIFY(w.choose(1) && w.make(5000, 5001, "segmentReplace"));
  w.showPage();
  const int steps = w.steps();
  QVERIFY(w.grow());
  QCOMPARE(w.steps(), steps);
  QVERIFY(w.child<Banner>("banner")->sentence().contains(QStringLiteral("at least two segments")));
}

void TestSegmentGrowing::hiddenAndLockedSegmentsStay() {
  GrowWindow w;
  QVERIFY(w.makeSeeds() && w.make(216, 225));
  const BitMask third = w.mask(3);
  QVERIFY(!third.empty());
  w.showPage();
  w.everywhere();
  for (const int column : {0, 1}) {
    w.tick(2, column);  // hidden, then locked
    QVERIFY(w.grow());
    QVERIFY(w.mask(3) == third);
    QCOMPARE(w.voxels(2), std::int64_t(40 * 40 * 40) - voxelsWhere(isInBall) - third.count());
    w.undo();
    w.tick(2, column);
  }
  QVERIFY(w.grow());
  QVERIFY2(w.voxels(3) > third.count(), "a seed like the others");
}

void TestSegmentGrowing::thePreviewFollowsTheSeeds() {
  GrowWindow w;
  QVERIFY(w.makeSeeds());
  w.everywhere();
  w.showPlace(ballMiddle + 0.5);
  const glm::dvec3 inBall(ballMiddle.x + 5, ballMiddle.y, ballMiddle.z), beside(12, 12, ballMiddle.z);
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull() && !w.isTintedAt(inBall), longest);
  const Workspace before = w.workspace();
  w.setPreview(true);
  QVERIFY(w.idle());
  QTRY_VERIFY_WITH_TIMEOUT(w.isTintedAt(inBall) && w.isTintedAt(beside), longest);
  QVERIFY2(w.workspace() == before, "it is only looked at");
  const QColor asSecond = w.colourAt(beside);
  // A third seed takes the voxels nearer to it.
  QVERIFY(w.make(216, 225));
  QVERIFY(w.idle());
  const glm::dvec3 nearThird(10, -10, ballMiddle.z);
  QTRY_VERIFY_WITH_TIMEOUT(w.isTintedAt(nearThird) && w.colourAt(nearThird) != asSecond, longest);
  w.showPage();
  w.setPreview(false);
  QTRY_VERIFY_WITH_TIMEOUT(!w.isTintedAt(inBall) && !w.isTintedAt(nearThird), longest);
  // With one seed left there is nothing to preview.
  w.setPreview(true);
  QVERIFY(w.idle());
  w.tick(0, 0), w.tick(1, 0);
  QVERIFY(!w.button("growPreview")->isChecked());
  QVERIFY(w.idle());
  QTRY_VERIFY_WITH_TIMEOUT(!w.isTintedAt(nearThird), longest);
}

void TestSegmentGrowing::thePreviewEndsWithItsSeries() {
  GrowWindow w;
  QVERIFY(w.makeSeeds());
  w.setPreview(true);
  w.session().show(ballWithSeeds());
  QVERIFY(w.idle());
  QVERIFY(!w.button("growPreview")->isChecked());
  QVERIFY(w.child<Banner>("banner")->sentence().isEmpty());
}

void TestSegmentGrowing::aJobThatIsCancelledChangesNothing() {
  GrowWindow w;
  QVERIFY(w.makeSeeds());
  w.everywhere();
  const Workspace before = w.workspace();
  for (const char* name : {"segmentGrow", "growPreview"}) {
    w.click(name);
    QCOMPARE(w.window.jobs().rows().size(), std::size_t(1));
    w.window.jobs().cancel(w.window.jobs().rows().front().id);
    QVERIFY(w.idle());
    QTest::qWait(50);
    QVERIFY(w.workspace() == before);
    QVERIFY(!w.button("growPreview")->isChecked());
  }
  QVERIFY(w.grow());
  QCOMPARE(w.voxels(1), voxelsWhere(isInBall));
}

VOLUMEN_TEST(TestSegmentGrowing);
#include "tst_segment_growing.moc"
