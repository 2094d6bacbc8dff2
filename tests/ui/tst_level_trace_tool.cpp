// Guards the level tracing tool. The closed contour at the value under the pointer is drawn in slices of any
// plane. A click adds its inside to the current segment, Ctrl+click erases it, one undo step each.
#include <glm/geometric.hpp>

#include "tests/ui/segment_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"
#include "viewer/segment/brush.h"
#include "viewer/slice/level_trace.h"

using namespace volumen;
using namespace volumen::tests;

class TestLevelTraceTool : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aClickTakesWhatIsInside_data();
  void aClickTakesWhatIsInside();
  void withCtrlItIsErased();
  void theLineFollowsThePointer();
  void whereThereIsNothingNothingIsDone();
  void escPutsTheToolAway();
};

namespace {

constexpr glm::dvec3 traceMiddle(1.5, -2.5, 0.5);  // a voxel centre

// Returns a volume of 1000 in the middle that falls by 50 per mm.
LoadedSeriesPtr fadingBall() {
  auto series = std::make_shared<LoadedSeries>(
      *seriesOf(volumeOf<float>(glm::ivec3(40), glm::dmat3(1), [](glm::dvec3 pVoxel) {
        return std::max(0.0, 1000 - 50 * glm::distance(pVoxel - 19.5, traceMiddle));
      })));
  series->series.acquired = series->volume->geometry();
  return series;
}

struct TraceWindow : SegmentWindow {
  TraceWindow() : SegmentWindow(fadingBall()) {
    click("segmentGrowing");
    child<QAction>("levelTraceTool")->trigger();
  }
  // Shows the slice through the middle and returns the pixel `mm` beside it.
  QPoint beside(double mm, ViewId id = axialViewId) {
    showPlace(traceMiddle, id);
    const glm::dvec2 pixel = view(id)->plane()->pixelFromPatient(traceMiddle);
    return {int(pixel.x + mm / view(id)->plane()->mmPerPixel), int(pixel.y)};
  }
  // Returns the voxels that the kernels compute.
  BitMask expected(QPoint at, ViewId id = axialViewId) {
    const SlicePlane plane = *view(id)->plane();
    const Volume& volume = *session().series()->volume;
    std::vector<glm::dvec3> outline;
    for (const glm::dvec2 p : levelTrace(*resampleSlice(volume, plane), {at.x(), at.y()}))
      outline.push_back(plane.patientFromPixel(p));
    BitMask mask(volume.geometry());
    addSpans(mask, insideOutline(volume.geometry(), outline, plane.normal()));
    return mask;
  }
  void clickAt(QPoint at, ViewId id = axialViewId, Qt::KeyboardModifiers keys = {}) {
    QTest::mouseClick(view(id), Qt::LeftButton, keys, at);
  }
};

}  // namespace

void TestLevelTraceTool::aClickTakesWhatIsInside_data() {
  QTest::addColumn<int>("view");
  QTest::addColumn<bool>("isOblique");
  QTest::newRow("axial") << int(axialViewId) << false;
  QTest::newRow("oblique sagittal") << int(sagittalViewId) << true;
}

void TestLevelTraceTool::aClickTakesWhatIsInside() {
  QFETCH(int, view);
  QFETCH(bool, isOblique);
  TraceWindow w;
  if (isOblique) w.turnPlanes();
  const QPoint at = w.beside(7.2, ViewId(view));
  const Workspace before = w.workspace();
  const int steps = w.steps();
  const BitMask expected = w.expected(at, ViewId(view));
  QVERIFY(expected.count() > 100);
  w.clickAt(at, ViewId(view));
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  QCOMPARE(w.count(), std::size_t(1));
  QVERIFY(w.mask(w.current().number) == expected);
  const Workspace after = w.workspace();
  w.undo();
  QVERIFY(w.isAs(before));
  w.redo();
  QVERIFY(w.workspace() == after);
}

void TestLevelTraceTool::withCtrlItIsErased() {
  TraceWindow w;
  const QPoint wide = w.beside(9), narrow = w.beside(4);
  const BitMask all = w.expected(wide), core = w.expected(narrow);
  w.clickAt(wide);
  const Workspace before = w.workspace();
  const int steps = w.steps();
  w.clickAt(narrow, axialViewId, Qt::ControlModifier);
  QVERIFY(w.idle());
  QCOMPARE(w.steps(), steps + 1);
  QVERIFY(!core.empty() && core != all);
  QVERIFY(w.mask(1) == subtracted(all, core));
  w.undo();
  QVERIFY(w.workspace() == before);
}

// The line's colour occurs neither in a grey picture nor in the crosshair's lines, from which the tested
// pixels keep clear.
void TestLevelTraceTool::theLineFollowsThePointer() {
  TraceWindow w;
  const QPoint middle = w.beside(0);
  const double pixels = 1 / w.view()->plane()->mmPerPixel;
  const auto place = [&](double mm) { return middle + (QPointF(0.6, 0.8) * mm * pixels).toPoint(); };
  const auto isDrawnAt = [&](QPoint p) {
    const QImage seen = w.view()->grab().toImage();
    for (int dx = -3; dx <= 3; ++dx)
      if (const QColor c = seen.pixelColor(p.x() + dx, p.y()); c.blue() > c.red() + 40) return true;
    return false;
  };
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  const Workspace before = w.workspace();
  QVERIFY(!isDrawnAt(place(-8)));
  hover(w.view(), place(8));
  QVERIFY(isDrawnAt(place(-8)));
  hover(w.view(), place(4));
  QVERIFY(!isDrawnAt(place(-8)) && isDrawnAt(place(-4)));
  QEvent leave(QEvent::Leave);
  QCoreApplication::sendEvent(w.view(), &leave);
  QVERIFY(!isDrawnAt(place(-4)));
  QVERIFY(w.workspace() == before);
}

void TestLevelTraceTool::whereThereIsNothingNothingIsDone() {
  TraceWindow w;
  w.beside(0);
  const SlicePlane plane = *w.view()->plane();
  const glm::dvec2 left = plane.pixelFromPatient({-20.5, 0, traceMiddle.z}),
                   above = plane.pixelFromPatient({0, -20.5, traceMiddle.z});
  QVERIFY(left.x >= 1 || above.y >= 1);
  const Workspace before = w.workspace();
  w.clickAt(left.x >= 1 ? QPoint(int(left.x) - 1, int(left.y)) : QPoint(int(above.x), int(above.y) - 1));
  QVERIFY(w.idle());
  QVERIFY(w.workspace() == before);
  QVERIFY(w.child<Banner>("banner")->sentence().isEmpty());
}

void TestLevelTraceTool::escPutsTheToolAway() {
  TraceWindow w;
  w.clickAt(w.beside(6));
  QCOMPARE(&w.window.views()->tool(), &toolNamed("levelTrace"));
  QTest::keyClick(w.view(), Qt::Key_Escape);
  QVERIFY(&w.window.views()->tool() != &toolNamed("levelTrace"));
}

VOLUMEN_TEST(TestLevelTraceTool);
#include "tst_level_trace_tool.moc"
