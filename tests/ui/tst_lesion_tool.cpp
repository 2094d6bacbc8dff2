// Guards the lesion tool. A sphere dragged in a slice of any plane becomes a segment of its voxels above a
// share of the maximum or an SUV. It has a preview, makes one undo step, and reports why it refuses.
#include <QComboBox>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "results/segments/segment_record.h"
#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

class TestLesionTool : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aSphereMakesALesion_data();
  void aSphereMakesALesion();
  void lesionsAreCounted();
  void theyAreCountedOverAllMaps();
  void itIsSeenWhileItIsDrawn();
  void theSphereGoesThroughThePointerInOtherSlices();
  void escGivesItUp();
  void enterMakesIt();
  void refusedInASentence();
  void aClickIsNone();
};

namespace {

constexpr glm::dvec3 inLesion(2.5, -3.5, 1.5), inOther(-12.5, 11.5, -9.5);  // voxel centres
constexpr double lesionMm = 11, otherMm = 6, suvFactor = 0.5;

double coneValue(glm::dvec3 p) {
  return 16 * std::max(0.0, 1 - glm::distance(p, inLesion) / lesionMm) +
         10 * std::max(0.0, 1 - glm::distance(p, inOther) / otherMm);
}

// Returns two cones of 16 and 10 (8 and 5 SUVbw) in a background of 0. Above a share s of the top they are
// balls of (1 - s) of their radius.
LoadedSeriesPtr twoLesions(bool hasSuv = true) {
  auto series = std::make_shared<LoadedSeries>(*seriesOf(volumeOf<float>(
      glm::ivec3(40), glm::dmat3(1), [](glm::dvec3 pVoxel) { return coneValue(pVoxel - 19.5); })));
  series->series.acquired = series->volume->geometry();
  series->series.modality = "PT";
  series->series.unit = "Bq/ml";
  if (hasSuv)
    series->series.suv.bodyWeight = suvFactor;
  else
    series->series.suv.why = "PatientWeight (0010,1030) is missing";
  series->firstScene.transferFunction.points = {{1, {1, 1, 1}, 0.0}, {8, {1, 1, 1}, 1.0}};
  return series;
}

struct LesionWindow : SegmentWindow {
  explicit LesionWindow(const LoadedSeriesPtr& series = twoLesions()) : SegmentWindow(series) {
    click("segmentGrowing");
    child<QAction>("lesionTool")->trigger();
  }
  QPoint away(QPoint from, double mm, ViewId id = axialViewId) {
    return {from.x() + int(std::lround(mm / view(id)->plane()->mmPerPixel)), from.y()};
  }
  // Draws a sphere about a position and waits for its job.
  bool draw(glm::dvec3 p, double mm, ViewId id = axialViewId) {
    const QPoint at = showPlace(p, id);
    drag(view(id), at, away(at, mm, id));
    return idle();
  }
  bool press(glm::dvec3 p, double mm) {
    const QPoint at = showPlace(p);
    QTest::mousePress(view(), Qt::LeftButton, {}, at);
    QTest::mouseEvent(QTest::MouseMove, view(), Qt::LeftButton, {}, away(at, mm));
    return idle();
  }
  // Returns whether the picture has any coloured pixel.
  bool isTinted(ViewId id = axialViewId) {
    const QImage picture = view(id)->picture();
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x)
        if (const QColor c = picture.pixelColor(x, y); c.red() != c.green() || c.green() != c.blue())
          return true;
    return false;
  }
  // Returns whether a circle of `mm` about the lesion is drawn over the picture.
  bool hasCircle(double mm, ViewId id) {
    const QImage seen = view(id)->grab().toImage();
    const glm::dvec2 middle = view(id)->plane()->pixelFromPatient(inLesion);
    int yellow = 0;
    for (int degrees = 0; degrees < 360; degrees += 5) {
      const double turn = glm::radians(double(degrees)), reach = mm / view(id)->plane()->mmPerPixel;
      bool isThere = false;
      for (int far = -2; far <= 2; ++far) {
        const glm::dvec2 p = middle + (reach + far) * glm::dvec2(std::cos(turn), std::sin(turn));
        const QColor c = seen.pixelColor(int(p.x), int(p.y));
        isThere |= c.red() > 180 && c.green() > 150 && c.blue() < 140;
      }
      yellow += isThere;
    }
    return yellow > 50;
  }
  QString said() { return child<Banner>("banner")->sentence(); }
};

std::int64_t voxelsOfCone(double radius) {
  return voxelsWhere([&](glm::dvec3 p) { return glm::distance(p, inLesion) <= radius + 1e-6; });
}

}  // namespace

void TestLesionTool::aSphereMakesALesion_data() {
  QTest::addColumn<int>("threshold");
  QTest::addColumn<int>("view");
  QTest::addColumn<bool>("isOblique");
  QTest::addColumn<double>("radius");
  const double at41 = lesionMm * 0.59;
  QTest::newRow("41 %, axial") << 0 << int(axialViewId) << false << at41;
  QTest::newRow("50 %, oblique sagittal") << 1 << int(sagittalViewId) << true << lesionMm * 0.5;
  QTest::newRow("SUV 2.5") << 2 << int(axialViewId) << false << lesionMm * (1 - 2.5 / 8);
}

void TestLesionTool::aSphereMakesALesion() {
  QFETCH(int, threshold);
  QFETCH(int, view);
  QFETCH(bool, isOblique);
  QFETCH(double, radius);
  LesionWindow w;
  w.child<QComboBox>("lesionThreshold")->setCurrentIndex(threshold);
  w.showPlace(inLesion, ViewId(view));
  if (isOblique) w.turnPlanes();
  const Workspace before = w.workspace();
  const int steps = w.steps();
  const glm::dvec2 pixel = w.view(ViewId(view))->plane()->pixelFromPatient(inLesion);
  const QPoint at{int(pixel.x), int(pixel.y)};
  drag(w.view(ViewId(view)), at, w.away(at, 12.5, ViewId(view)));
  QVERIFY(w.idle());
  QVERIFY2(w.said().isEmpty(), qPrintable(w.said()));
  QCOMPARE(w.steps(), steps + 1);
  QCOMPARE(w.count(), std::size_t(1));
  QCOMPARE(w.segment(0).label, std::string("Lesion 1"));
  QCOMPARE(w.voxels(1), voxelsOfCone(radius));
  const Workspace after = w.workspace();
  w.undo();
  QVERIFY(w.isAs(before));
  w.redo();
  QVERIFY(w.workspace() == after);
  const RecordedRecipe recorded = recordedRecipe(*w.map(), "PT");
  QVERIFY(recorded.missing.empty());
  const auto followed = follow(recorded.recipe, *w.session().series()->volume);
  QVERIFY(followed && maskOf(followed->labels, 1) == w.mask(1));
}

// The tool stays active.
void TestLesionTool::lesionsAreCounted() {
  LesionWindow w;
  QVERIFY(w.draw(inLesion, 12.5) && w.draw(inOther, 8));
  QCOMPARE(w.count(), std::size_t(2));
  QCOMPARE(w.segment(1).label, std::string("Lesion 2"));
  QVERIFY(w.segment(0).colour && w.segment(0).colour != w.segment(1).colour);
  QVERIFY(!w.segment(1).description.empty());
  QCOMPARE(w.voxels(2),
           voxelsWhere([](glm::dvec3 p) { return glm::distance(p, inOther) <= otherMm * 0.59; }));
  QCOMPARE(w.voxels(1), voxelsOfCone(lesionMm * 0.59));
  QCOMPARE(w.current().number, 2);
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QVERIFY(!w.window.views()->tool().clicks);
}

void TestLesionTool::theyAreCountedOverAllMaps() {
  LesionWindow w;
  QVERIFY(w.draw(inOther, 8));
  w.click("segmentDuplicate");
  QVERIFY(w.idle());
  QCOMPARE(w.map()->number, 1);
  QVERIFY(w.draw(inLesion, 12.5));
  QCOMPARE(w.map()->number, 1);
  QCOMPARE(w.count(), std::size_t(2));
  QCOMPARE(w.current().label, std::string("Lesion 2"));
}

void TestLesionTool::itIsSeenWhileItIsDrawn() {
  LesionWindow w;
  const QPoint at = w.showPlace(inLesion);
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull() && !w.isTinted(), longest);
  const Workspace before = w.workspace();
  QVERIFY(w.press(inLesion, 12.5));
  QTRY_VERIFY_WITH_TIMEOUT(w.isTinted(), longest);
  QVERIFY2(w.workspace() == before, "nothing is changed yet");
  // Its circle is drawn over the pictures of all slices.
  for (const ViewId view : {axialViewId, coronalViewId, sagittalViewId}) QVERIFY(w.hasCircle(12.5, view));
  // A smaller sphere leaks. It shows no preview, and no message until it is released.
  QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {}, w.away(at, 4));
  QVERIFY(w.idle());
  QTRY_VERIFY_WITH_TIMEOUT(!w.isTinted(), longest);
  QVERIFY(w.said().isEmpty());
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, w.away(at, 12.5));
  QVERIFY(w.idle());
  QCOMPARE(w.count(), std::size_t(1));
  QTRY_VERIFY_WITH_TIMEOUT(w.isTinted(), longest);
  for (const ViewId view : {axialViewId, coronalViewId, sagittalViewId}) QVERIFY(!w.hasCircle(12.5, view));
}

// Moves 5 mm to another slice and 3 mm beside the centre, which is 5.8 mm and leaks. 12 mm beside the centre
// are 13 mm.
void TestLesionTool::theSphereGoesThroughThePointerInOtherSlices() {
  LesionWindow w;
  const QPoint at = w.showPlace(inLesion);
  for (const auto& [beside, isOne] : {std::pair(3.0, false), std::pair(12.0, true)}) {
    w.showPlace(inLesion);
    QTest::mousePress(w.view(), Qt::LeftButton, {}, at);
    wheel(w.view(), 5);
    QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {}, w.away(at, beside));
    QTest::mouseRelease(w.view(), Qt::LeftButton, {}, w.away(at, beside));
    QVERIFY(w.idle());
    QCOMPARE(w.count(), std::size_t(isOne ? 1 : 0));
  }
  QCOMPARE(w.voxels(1), voxelsOfCone(lesionMm * 0.59));
}

void TestLesionTool::escGivesItUp() {
  LesionWindow w;
  const QPoint at = w.showPlace(inLesion);
  const Workspace before = w.workspace();
  QVERIFY(w.press(inLesion, 12.5));
  QTRY_VERIFY_WITH_TIMEOUT(w.isTinted(), longest);
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QTRY_VERIFY_WITH_TIMEOUT(!w.isTinted(), longest);
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, w.away(at, 12.5));
  QVERIFY(w.idle());
  QVERIFY(w.workspace() == before);
}

void TestLesionTool::enterMakesIt() {
  LesionWindow w;
  const QPoint at = w.showPlace(inLesion);
  QVERIFY(w.press(inLesion, 12.5));
  QTest::keyClick(w.view(), Qt::Key_Return);
  QVERIFY(w.idle());
  QCOMPARE(w.count(), std::size_t(1));
  for (const ViewId view : {axialViewId, coronalViewId}) QVERIFY(!w.hasCircle(12.5, view));
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, w.away(at, 12.5));
  QVERIFY(w.idle());
  QCOMPARE(w.count(), std::size_t(1));
}

void TestLesionTool::refusedInASentence() {
  LesionWindow w(twoLesions(false));
  w.child<QComboBox>("lesionThreshold")->setCurrentIndex(2);
  w.showPlace(inLesion);
  const Workspace before = w.workspace();
  QVERIFY(w.draw(inLesion, 12.5));
  QVERIFY2(w.said().contains(QStringLiteral("no SUV: PatientWeight (0010,1030) is missing")),
           qPrintable(w.said()));
  QVERIFY(w.workspace() == before);
  // A share of the maximum works without an SUV.
  w.child<QComboBox>("lesionThreshold")->setCurrentIndex(0);
  QVERIFY(w.draw(inLesion, 12.5));
  QCOMPARE(w.count(), std::size_t(1));
  QVERIFY2(w.child<Banner>("banner")->isHidden(), "what was refused was done");
}

void TestLesionTool::aClickIsNone() {
  LesionWindow w;
  const QPoint at = w.showPlace(inLesion);
  const Workspace before = w.workspace();
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, at);
  QTest::mouseDClick(w.view(), Qt::LeftButton, {}, at);
  QVERIFY(w.idle());
  QVERIFY(w.workspace() == before && w.said().isEmpty());
}

VOLUMEN_TEST(TestLesionTool);
#include "tst_lesion_tool.moc"
