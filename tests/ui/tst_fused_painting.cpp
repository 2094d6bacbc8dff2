// Guards painting on fused slices: what is painted on a CT under a PET, whose segments the panel is about,
// is a segment of the PET on its own grid; by real mouse events.
#include "tests/ui/segment_window.h"
#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"
#include "viewer/segment/brush.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr const char* commonFrame = "1.2.3";

// Another grid than that of the CT: a ball whose values fall from its middle.
LoadedSeriesPtr hotBall() {
  auto series = std::make_shared<LoadedSeries>(*petIn(commonFrame));
  series->volume = volumeOf<float>({15, 15, 15}, glm::dmat3(2),
                                   [](glm::dvec3 p) { return 100 * (8 - glm::length(p - 7.0)); });
  series->series.acquired = series->volume->geometry();
  return series;
}

// The PET in 3D and in the panel, its CT under it in slices.
struct FusedPaintWindow : SegmentWindow {
  const LoadedSeriesPtr ct = ballIn(commonFrame);

  FusedPaintWindow() : SegmentWindow(hotBall()) {
    session().keep(ct);
    session().change(QStringLiteral("fused"), fusedWith(workspace(), ct->series));
    session().endGesture();
    session().prefer([](Preferences& p) { p.brush = {false, 8}; });
  }
  const VoxelGeometry& grid() { return session().series()->volume->geometry(); }
  QPoint right(QPoint from, double mm) {
    return {from.x() + int(mm / view()->plane()->mmPerPixel), from.y()};
  }
  QString said() { return child<Banner>("banner")->sentence(); }
};

}  // namespace

class TestFusedPainting : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theBrushPaintsOnTheGridOfTheOverlay();
  void anOutlineIsFilledOnTheGridOfTheOverlay();
  void valuesAreThoseOfTheOverlay_data();
  void valuesAreThoseOfTheOverlay();
};

void TestFusedPainting::theBrushPaintsOnTheGridOfTheOverlay() {
  FusedPaintWindow w;
  const QPoint from = w.showPlace({-4, 0, 0}), to = w.right(from, 6);
  w.child<QAction>("paintTool")->trigger();
  const Workspace before = w.workspace();
  QTest::mousePress(w.view(), Qt::LeftButton, {}, from);
  QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {}, to);
  QVERIFY2(w.count() == 1, "it is seen while it is drawn");
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, to);
  QVERIFY2(w.said().isEmpty(), qPrintable(w.said()));
  BitMask expected(w.grid());
  const glm::dvec3 normal = w.view()->plane()->normal();
  for (const QPoint start : {from, to})
    addSpans(expected, discStroke(w.grid(), w.patient(from), w.patient(start), normal, 4));
  QVERIFY(!expected.empty() && w.mask(1) == expected);
  w.undo();
  QVERIFY(w.isAs(before));
}

void TestFusedPainting::anOutlineIsFilledOnTheGridOfTheOverlay() {
  FusedPaintWindow w;
  const QPoint a = w.showPlace({-5, -5, 0}), b = w.right(a, 10), c(b.x(), b.y() + (b.x() - a.x()));
  w.child<QAction>("outlineTool")->trigger();
  for (const QPoint corner : {a, b, c}) QTest::mouseClick(w.view(), Qt::LeftButton, {}, corner);
  QTest::keyClick(w.view(), Qt::Key_Return);
  QVERIFY2(w.said().isEmpty(), qPrintable(w.said()));
  QCOMPARE(w.count(), std::size_t(1));
  const std::vector<glm::dvec3> outline{w.patient(a), w.patient(b), w.patient(c)};
  BitMask expected(w.grid());
  addSpans(expected, insideOutline(w.grid(), outline, w.view()->plane()->normal()));
  QVERIFY(!expected.empty() && w.mask(1) == expected);
}

void TestFusedPainting::valuesAreThoseOfTheOverlay_data() {
  QTest::addColumn<QByteArray>("tool");
  QTest::newRow("level trace") << QByteArray("levelTraceTool");
  QTest::newRow("smart brush") << QByteArray("smartBrushTool");
}

// In the CT all is alike there.
void TestFusedPainting::valuesAreThoseOfTheOverlay() {
  QFETCH(QByteArray, tool);
  FusedPaintWindow w;
  w.child<QAction>(tool.constData())->trigger();
  const QPoint at = w.showPlace({5, 0, 0});
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, at);
  QVERIFY2(w.said().isEmpty(), qPrintable(w.said()));
  QCOMPARE(w.count(), std::size_t(1));
  const BitMask made = w.mask(1);
  QVERIFY(made.geometry() == w.grid());
  QVERIFY(!made.empty() && made.count() < 100);  // a disc of at most 6 mm, of voxels of 2 mm
}

VOLUMEN_TEST(TestFusedPainting);
#include "tst_fused_painting.moc"
