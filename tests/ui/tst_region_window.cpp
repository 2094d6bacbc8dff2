// Guards the window from a region. A box in a slice or frame sets the window from P1 to P99 of its visible
// values. Checked against closed forms and, at random, a ramp with known percentiles. It is one undo step,
// and the previous tool returns.
#include "tests/fixtures/chance.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/measure_window.h"
#include "ui/workspace/windows.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns a series with `value` at each patient position.
LoadedSeriesPtr seriesBy(const std::function<double(glm::dvec3)>& value) {
  const glm::ivec3 size{48, 48, 8};
  const glm::dvec3 middle = (glm::dvec3(size) - 1.0) / 2.0;  // voxel at the patient's origin
  auto series = std::make_shared<LoadedSeries>(*seriesOf(volumeOf<std::int16_t>(
      size, glm::dmat3(1), [&](glm::dvec3 pVoxel) { return value(pVoxel - middle); })));
  series->series.acquired = series->volume->geometry();
  series->valueSpread = 1000;
  return series;
}

struct RegionWindow : MeasureWindow {
  using MeasureWindow::MeasureWindow;

  void box(QPointF from, QPointF to, Qt::KeyboardModifiers keys = {}) {
    child<QAction>("regionWindowTool")->trigger();
    drag(view(), from, to, Qt::LeftButton, keys);
  }
  std::optional<Window> windowSet() { return session().workspace().series.at(view()->state().series).window; }
  int steps() { return session().undoStack().index(); }
};

}  // namespace

class TestRegionWindow : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void percentilesAreByRank();
  void aRampGivesItsPercentiles();
  void aSpeckDecidesNothing();
  void oneValueIsStillAWindow();
  void itIsOneStepAndOneUse();
  void aClickIsNoBox();
  void theBoxHasNoNumbers();
  void escapeGivesItUp();
  void framesToo();
  void coloursHaveNone();
};

void TestRegionWindow::percentilesAreByRank() {
  const LoadedSeriesPtr series = seriesBy([](glm::dvec3) { return 0; });
  std::vector<float> values;
  for (int n = 200; n >= 1; --n) values.push_back(float(n));
  values.push_back(std::nanf(""));
  // Ranks 2 and 198 of 200.
  QCOMPARE(windowOfValues(values, {40, 400}, *series), std::optional(Window{100, 196}));
  QCOMPARE(windowOfValues(values, {40, -400}, *series), std::optional(Window{100, -196}));
  QCOMPARE(windowOfValues({3}, {40, 400}, *series), std::optional(Window{3, 0.25}));
  QVERIFY(!windowOfValues({}, {40, 400}, *series));
  QVERIFY(!windowOfValues({std::nanf("")}, {40, 400}, *series));
}

void TestRegionWindow::aRampGivesItsPercentiles() {
  RegionWindow w(seriesBy([](glm::dvec3 p) { return 100 * p.x; }));
  const SlicePlane plane = *w.view()->plane();
  // Stays inside the picture: the volume is 48 mm wide, in the middle of the view.
  const QPointF middle = QRectF(w.view()->rect()).center();
  const double reach = 20 / plane.mmPerPixel;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    Chance chance(seed);
    const auto at = [&] { return std::floor((chance.below(1000) / 500.0 - 1) * reach); };
    const QPoint from = (middle + QPointF(at(), at())).toPoint(),
                 to = (middle + QPointF(at(), at())).toPoint();
    if (std::abs(from.x() - to.x()) < 8 || std::abs(from.y() - to.y()) < 8) continue;
    w.box(from, to);
    QVERIFY(w.windowSet());
    const double a = 100 * w.patient(from).x, b = 100 * w.patient(to).x, low = std::min(a, b),
                 wide = std::abs(b - a);
    const WindowEnds ends = endsOf(*w.windowSet());
    // Values rise evenly from side to side. A sample stands for a pixel, so each end is known to one pixel.
    const double pixel = 100 * plane.mmPerPixel;
    QVERIFY2(std::abs(ends.dark - (low + 0.01 * wide)) <= pixel, qPrintable(QString::number(seed)));
    QVERIFY2(std::abs(ends.bright - (low + 0.99 * wide)) <= pixel, qPrintable(QString::number(seed)));
  }
}

void TestRegionWindow::aSpeckDecidesNothing() {
  const auto metal = [](glm::dvec3 p) {
    return glm::length(glm::dvec2(p) - glm::dvec2(0.5)) < 0.6 ? 30000 : 10 * p.y;
  };
  RegionWindow w(seriesBy(metal));
  const QPointF middle = QRectF(w.view()->rect()).center();
  const double reach = 18 / w.view()->plane()->mmPerPixel;
  w.box(middle - QPointF(reach, reach), middle + QPointF(reach, reach));
  QVERIFY(w.windowSet());
  // The speck with its slopes covers less than 2 x 2 of 36 x 36 mm, which is below 1 %.
  QVERIFY2(endsOf(*w.windowSet()).bright < 200, qPrintable(QString::number(endsOf(*w.windowSet()).bright)));
}

void TestRegionWindow::oneValueIsStillAWindow() {
  RegionWindow w(seriesBy([](glm::dvec3) { return 77; }));
  const QPointF middle = QRectF(w.view()->rect()).center();
  w.box(middle, middle + QPointF(30, 30));
  // One 4000th of the range of values, which is also the minimum of a drag.
  QCOMPARE(w.windowSet(), std::optional(Window{77, 0.25}));
}

void TestRegionWindow::itIsOneStepAndOneUse() {
  RegionWindow w;
  const Workspace before = w.session().workspace();
  const int steps = w.steps();
  const QPointF middle = QRectF(w.view()->rect()).center();
  w.box(middle, middle + QPointF(40, 30));
  QCOMPARE(w.steps(), steps + 1);
  QVERIFY(w.windowSet() && w.all().empty());
  QCOMPARE(&w.window.views()->tool(), &toolNamed("window"));
  QVERIFY(w.view()->drawnMeasurements().empty());
  w.undo();
  QVERIFY(w.session().workspace() == before);
  // Shift keeps the tool, as for measuring tools.
  w.box(middle, middle + QPointF(40, 30), Qt::ShiftModifier);
  QCOMPARE(&w.window.views()->tool(), &toolNamed("regionWindow"));
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QCOMPARE(&w.window.views()->tool(), &toolNamed("window"));
}

void TestRegionWindow::aClickIsNoBox() {
  RegionWindow w;
  const Workspace before = w.session().workspace();
  w.box({90, 90}, {92, 91});
  QVERIFY(w.session().workspace() == before);
  QCOMPARE(&w.window.views()->tool(), &toolNamed("regionWindow"));
}

void TestRegionWindow::theBoxHasNoNumbers() {
  RegionWindow w;
  const auto textsOf = [&](const char* tool) {
    w.child<QAction>(tool)->trigger();
    QTest::mousePress(w.view(), Qt::LeftButton, {}, {90, 90});
    QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {}, {140, 150});
    QStringList text;
    const auto drawn = w.view()->drawnMeasurements();
    for (const DrawnMeasurement& each : drawn) text << each.text;
    QTest::keyClick(w.view(), Qt::Key_Escape);
    QTest::mouseRelease(w.view(), Qt::LeftButton, {}, {140, 150});
    return text;
  };
  QVERIFY(!textsOf("rectangleTool").isEmpty());
  QCOMPARE(textsOf("regionWindowTool"), QStringList());
}

void TestRegionWindow::escapeGivesItUp() {
  RegionWindow w;
  const Workspace before = w.session().workspace();
  w.child<QAction>("regionWindowTool")->trigger();
  QTest::mousePress(w.view(), Qt::LeftButton, {}, {90, 90});
  QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {}, {140, 150});
  QCOMPARE(w.view()->drawnMeasurements().size(), std::size_t(1));
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, {140, 150});
  QVERIFY(w.session().workspace() == before);
  QVERIFY(w.view()->drawnMeasurements().empty());
}

void TestRegionWindow::framesToo() {
  NEED_FILES();
  Frames w({"cr-hip-mono2-jpeg12.dcm"});
  QVERIFY(w.shows());
  w.child<QAction>("regionWindowTool")->trigger();
  const QPointF middle = QRectF(w.view()->rect()).center();
  QVERIFY(w.after([&] { drag(w.view(), middle - QPointF(40, 40), middle + QPointF(40, 40)); }));
  const std::optional<Window> window = w.workspace().series.at(w.view()->state().series).window;
  QVERIFY(window && window->width > 0);
  // Expected values are of pixels whose centres lie in the box. Interpolation reaches half a pixel further.
  const LoadedFramePtr frame = frameIn(w.view());
  const VoxelGeometry& geometry = frame->geometry();
  const SlicePlane plane = *w.view()->plane();
  const double ratio = w.view()->devicePixelRatioF();
  const auto pixelOf = [&](QPointF p) {
    return glm::dvec2(geometry.voxelFromPatient(plane.patientFromPixel({p.x() * ratio, p.y() * ratio})));
  };
  const glm::dvec2 a = pixelOf(middle - QPointF(40, 40)), b = pixelOf(middle + QPointF(40, 40));
  std::vector<float> inside;
  for (int y = int(std::ceil(std::min(a.y, b.y))); y <= std::max(a.y, b.y); ++y)
    for (int x = int(std::ceil(std::min(a.x, b.x))); x <= std::max(a.x, b.x); ++x)
      inside.push_back(frame->slice->volume->value(x, y, 0));
  std::ranges::sort(inside);
  const double low = inside[inside.size() / 100], high = inside[inside.size() * 99 / 100];
  // Screen samples differ from the pixels, so P1 and P99 agree to a tenth of their difference.
  QVERIFY2(std::abs(endsOf(*window).dark - low) < (high - low) / 10, qPrintable(QString::number(low)));
  QVERIFY2(std::abs(endsOf(*window).bright - high) < (high - low) / 10, qPrintable(QString::number(high)));
}

void TestRegionWindow::coloursHaveNone() {
  NEED_FILES();
  Frames w({"sc-rgb-41.dcm"});
  QVERIFY(w.shows());
  const Workspace before = w.workspace();
  w.child<QAction>("regionWindowTool")->trigger();
  const QPointF middle = QRectF(w.view()->rect()).center();
  drag(w.view(), middle - QPointF(40, 40), middle + QPointF(40, 40));
  QVERIFY(w.workspace() == before);
}

VOLUMEN_TEST(TestRegionWindow);
#include "tst_region_window.moc"
