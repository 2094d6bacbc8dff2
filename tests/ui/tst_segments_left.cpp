// Guards jobs on segments whose series is left for another one, or closed, meanwhile.
#include <QMenu>
#include <QToolButton>

#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct LeftJob {
  void (*prepare)(SegmentWindow& w);  // null if nothing is to be prepared
  void (*begin)(SegmentWindow& w);
  bool makesStep;
};

}  // namespace

Q_DECLARE_METATYPE(LeftJob)

class TestSegmentsLeft : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aSeriesIsLeftDuringAJob_data();
  void aSeriesIsLeftDuringAJob();
  void aSeriesIsClosedDuringAJob_data() { aSeriesIsLeftDuringAJob_data(); }
  void aSeriesIsClosedDuringAJob();
};

void TestSegmentsLeft::aSeriesIsLeftDuringAJob_data() {
  QTest::addColumn<LeftJob>("job");
  using W = SegmentWindow&;
  const auto row = [](const char* name, void (*begin)(W), void (*prepare)(W) = nullptr,
                      bool makesStep = true) {
    QTest::newRow(name) << LeftJob{prepare, begin, makesStep};
  };
  row("range", [](W w) {
    w.click("segmentFromCurve");
    w.child<QDoubleSpinBox>("segmentLow")->setValue(-5);
    w.child<QDoubleSpinBox>("segmentHigh")->setValue(5);
    w.click("segment");
  });
  row(
      "connected part",
      [](W w) {
        const glm::dvec2 at = w.view()->plane()->pixelFromPatient(inSmallBall);
        QTest::mouseClick(w.view(), Qt::LeftButton, Qt::AltModifier, {int(at.x), int(at.y)});
      },
      [](W w) {
        w.child<QAction>("partTool")->trigger();
        w.showPlace(inSmallBall);
      });
  row(
      "step", [](W w) { w.click("segmentApply"); }, [](W w) { w.chooseStep("grow"); });
  row(
      "split", [](W w) { w.click("segmentApply"); }, [](W w) { w.chooseStep("split"); });
  row(
      "merge", [](W w) { w.click("segmentApply"); }, [](W w) { w.chooseStep("merge"); });
  row(
      "all smoothed", [](W w) { w.click("segmentApply"); },
      [](W w) {
        w.chooseStep("joint");
        w.setField("sigmaMm", 2);
      });
  row(
      "cut segment",
      [](W w) {
        const glm::dvec2 at = w.view()->plane()->pixelFromPatient(inSmallBall);
        const int half = int(5 / w.view()->plane()->mmPerPixel);
        const QPoint middle{int(at.x), int(at.y)};
        QTest::mousePress(w.view(), Qt::LeftButton, {}, middle + QPoint(-half, -half));
        for (const QPoint by : {QPoint(half, -half), QPoint(half, half), QPoint(-half, half)})
          QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {}, middle + by);
        QTest::mouseRelease(w.view(), Qt::LeftButton, {}, middle + QPoint(-half, half));
      },
      [](W w) {
        w.child<QAction>("segmentScissorsTool")->trigger();
        w.showPlace(inSmallBall);
      });
  row("removed", [](W w) { w.click("segmentRemove"); });
  row(
      "fill between slices", [](W w) { w.click("segmentFillBetween"); },
      [](W w) { w.click("segmentPaint"); });
  row(
      "grow from seeds", [](W w) { w.click("segmentGrow"); }, [](W w) { w.click("segmentGrowing"); });
  row(
      "lesion",
      [](W w) {
        const glm::dvec2 at = w.view()->plane()->pixelFromPatient(inSmallBall);
        drag(w.view(), {at.x, at.y}, {at.x + 6 / w.view()->plane()->mmPerPixel, at.y});
      },
      [](W w) {
        w.child<QAction>("lesionTool")->trigger();
        w.showPlace(inSmallBall);
      });
  row("recipe", [](W w) {
    for (QAction* action : w.child<QToolButton>("segmentRecipes")->menu()->actions())
      if (action->objectName() == QStringLiteral("recipeBone")) return action->trigger();
    QFAIL("there is no such recipe");
  });
  row(
      "preview", [](W w) { w.click("growPreview"); }, [](W w) { w.click("segmentGrowing"); }, false);
  row(
      "numbers", [](W w) { w.click("segmentNumbersButton"); }, nullptr, false);
}

// The job's result for a series is the same if another series is shown meanwhile, which does not change.
void TestSegmentsLeft::aSeriesIsLeftDuringAJob() {
  QFETCH(LeftJob, job);
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  if (job.prepare) job.prepare(w);
  const SeriesKey series = w.series();
  const Workspace before = w.workspace();
  const int steps = w.steps();
  SegmentMap expected = *w.map();
  if (job.makesStep) {
    job.begin(w);
    QVERIFY(w.idle());
    QCOMPARE(w.steps(), steps + 1);
    expected = *w.map();
    QVERIFY(!(expected == before.segmentMaps.front()));
    w.undo();
    QVERIFY(w.idle() && w.isAs(before));
  }
  job.begin(w);
  QVERIFY(!w.window.jobs().rows().empty());
  w.session().show(hollowBalls());
  QVERIFY(w.series() != series);
  QVERIFY(w.idle());
  QTest::qWait(50);
  QVERIFY(!w.map());
  const SegmentMap* made = segmentMapOf(w.workspace(), series);
  QVERIFY(made && *made == expected);
  QCOMPARE(w.steps(), steps + (job.makesStep ? 2 : 1));
  while (w.steps() > steps) w.undo();
  QVERIFY(w.idle() && w.isAs(before));
}

void TestSegmentsLeft::aSeriesIsClosedDuringAJob() {
  QFETCH(LeftJob, job);
  SegmentWindow w;
  QVERIFY(w.makeBoth());
  if (job.prepare) job.prepare(w);
  const Workspace before = w.workspace();
  const int steps = w.steps();
  job.begin(w);
  QVERIFY(!w.window.jobs().rows().empty());
  w.session().close({w.series()});
  QVERIFY(w.idle());
  QTest::qWait(50);
  QVERIFY(w.workspace().segmentMaps.empty());
  QVERIFY(w.child<Banner>("banner")->sentence().isEmpty());
  QCOMPARE(w.steps(), steps + 1);
  w.undo();
  QVERIFY(w.idle());
  QVERIFY(w.isAs(before));
}

VOLUMEN_TEST(TestSegmentsLeft);
#include "tst_segments_left.moc"
