// Guards painting on fused slices. If the Segments panel belongs to a PET over a CT, painting, cutting and
// clicking make segments of the PET on its own grid. Real mouse events.
#include <cmath>

#include "tests/ui/cut_window.h"
#include "tests/ui/two_series.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/links.h"
#include "viewer/segment/brush.h"

using namespace volumen;
using namespace volumen::tests;

Q_DECLARE_METATYPE(volumen::Rigid)

namespace {

constexpr const char *commonFrame = "1.2.3", *ownFrame = "4.5.6";

// Returns a ball whose values fall from its centre, on another grid than the CT's.
LoadedSeriesPtr hotBall(const char* frame) {
  auto series = std::make_shared<LoadedSeries>(*petIn(frame));
  series->volume = volumeOf<float>({15, 15, 15}, glm::dmat3(2),
                                   [](glm::dvec3 p) { return 100 * (8 - glm::length(p - 7.0)); });
  series->series.acquired = series->volume->geometry();
  return series;
}

// The PET in 3D and in the panel, over its CT in slices. They share a frame of reference or are registered.
struct FusedPaintWindow : SegmentWindow {
  const LoadedSeriesPtr ct = ballIn(commonFrame);
  const Rigid petFromCt;

  explicit FusedPaintWindow(const Rigid& petPlace = {})
      : SegmentWindow(hotBall(petPlace == Rigid{} ? commonFrame : ownFrame)), petFromCt(petPlace) {
    session().keep(ct);
    session().change(QStringLiteral("fused"), fusedWith(workspace(), ct->series));
    if (petFromCt != Rigid{})
      session().change(QStringLiteral("registered"),
                       withRegistration(workspace(), frameOfReference(ct->series),
                                        frameOfReference(session().series()->series), petFromCt));
    session().endGesture();
    session().prefer([](Preferences& p) { p.brush = {false, 8}; });
  }
  const VoxelGeometry& grid() { return session().series()->volume->geometry(); }
  QPoint right(QPoint from, double mm) {
    return {from.x() + int(mm / view()->plane()->mmPerPixel), from.y()};
  }
  QString said() { return child<Banner>("banner")->sentence(); }
  glm::dvec2 pixelOf(glm::dvec3 pPet) { return view()->plane()->pixelFromPatient(petFromCt.inverse()(pPet)); }
  glm::dvec3 inPet(QPoint pixel) { return petFromCt(patient(pixel, axialViewId)); }
  glm::dvec3 normalInPet() { return petFromCt.rotation * view()->plane()->normal(); }
  // Shows the slice of the CT at a position of the PET and returns its pixel.
  QPoint showOfPet(glm::dvec3 pPet) {
    session().change(QStringLiteral("test"), [&](Workspace& after) {
      after.crosshairs.editOrAdd(frameOfReference(ct->series)).at = petFromCt.inverse()(pPet);
    });
    session().endGesture();
    const glm::dvec2 pixel = pixelOf(pPet);
    return {int(pixel.x), int(pixel.y)};
  }
  template <class IsIn>
  BitMask voxelsOf(const IsIn& isIn) {
    BitMask made(grid());
    const glm::ivec3 size = grid().size;
    for (int k = 0; k < size.z; ++k)
      for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i)
          if (isIn(glm::ivec3(i, j, k))) made.set({i, j, k});
    return made;
  }
  // Returns the segment's part inside an outline by pixels.
  SeenPart inside(const std::vector<QPoint>& corners) {
    const QPolygonF outline(QList<QPointF>(corners.begin(), corners.end()));
    const auto pixel = [&](glm::ivec3 voxel) { return pixelOf(grid().patientFromVoxel(voxel)); };
    return {voxelsOf([&](glm::ivec3 voxel) {
              const glm::dvec2 at = pixel(voxel);
              return outline.containsPoint({at.x, at.y}, Qt::WindingFill);
            }),
            voxelsOf([&](glm::ivec3 voxel) { return fromOutline(corners, pixel(voxel)) < 1e-6; })};
  }
};

void addPlacesOfThePet() {
  QTest::addColumn<Rigid>("petFromCt");
  QTest::newRow("one frame of reference") << Rigid{};
  const double c = std::cos(0.3), s = std::sin(0.3);
  QTest::newRow("registered") << Rigid{{{c, s, 0}, {-s, c, 0}, {0, 0, 1}}, {6, -2, 1}};
}

}  // namespace

class TestFusedPainting : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theBrushPaintsOnTheGridOfTheOverlay_data() { addPlacesOfThePet(); }
  void theBrushPaintsOnTheGridOfTheOverlay();
  void anOutlineIsFilledOnTheGridOfTheOverlay_data() { addPlacesOfThePet(); }
  void anOutlineIsFilledOnTheGridOfTheOverlay();
  void valuesAreThoseOfTheOverlay_data();
  void valuesAreThoseOfTheOverlay();
  void itsSegmentIsCut_data() { addPlacesOfThePet(); }
  void itsSegmentIsCut();
  void itsConnectedPartIsTaken_data() { addPlacesOfThePet(); }
  void itsConnectedPartIsTaken();
  void withoutTheOverlayTheCtIsNotChanged_data();
  void withoutTheOverlayTheCtIsNotChanged();
};

void TestFusedPainting::theBrushPaintsOnTheGridOfTheOverlay() {
  QFETCH(Rigid, petFromCt);
  FusedPaintWindow w(petFromCt);
  const QPoint from = w.showOfPet({-4, 0, 0}), to = w.right(from, 6);
  w.child<QAction>("paintTool")->trigger();
  const Workspace before = w.workspace();
  QTest::mousePress(w.view(), Qt::LeftButton, {}, from);
  QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {}, to);
  QVERIFY2(w.count() == 1, "it is seen while it is drawn");
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, to);
  QVERIFY2(w.said().isEmpty(), qPrintable(w.said()));
  BitMask expected(w.grid());
  for (const QPoint start : {from, to})
    addSpans(expected, discStroke(w.grid(), w.inPet(from), w.inPet(start), w.normalInPet(), 4));
  QVERIFY(!expected.empty() && w.mask(1) == expected);
  w.undo();
  QVERIFY(w.isAs(before));
}

void TestFusedPainting::anOutlineIsFilledOnTheGridOfTheOverlay() {
  QFETCH(Rigid, petFromCt);
  FusedPaintWindow w(petFromCt);
  const QPoint a = w.showOfPet({-5, -5, 0}), b = w.right(a, 10), c(b.x(), b.y() + (b.x() - a.x()));
  w.child<QAction>("outlineTool")->trigger();
  for (const QPoint corner : {a, b, c}) QTest::mouseClick(w.view(), Qt::LeftButton, {}, corner);
  QTest::keyClick(w.view(), Qt::Key_Return);
  QVERIFY2(w.said().isEmpty(), qPrintable(w.said()));
  QCOMPARE(w.count(), std::size_t(1));
  const std::vector<glm::dvec3> outline{w.inPet(a), w.inPet(b), w.inPet(c)};
  BitMask expected(w.grid());
  addSpans(expected, insideOutline(w.grid(), outline, w.normalInPet()));
  QVERIFY(!expected.empty() && w.mask(1) == expected);
}

void TestFusedPainting::valuesAreThoseOfTheOverlay_data() {
  QTest::addColumn<QByteArray>("tool");
  QTest::newRow("level trace") << QByteArray("levelTraceTool");
  QTest::newRow("smart brush") << QByteArray("smartBrushTool");
}

// The CT is uniform there.
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
  QVERIFY(!made.empty() && made.count() < 100);  // a disc of at most 6 mm with voxels of 2 mm
}

// The cut is a recipe step that can be repeated on the PET alone.
void TestFusedPainting::itsSegmentIsCut() {
  QFETCH(Rigid, petFromCt);
  FusedPaintWindow w(petFromCt);
  QVERIFY(w.make(1.6, 5));
  const BitMask own = w.mask(1);
  w.child<QAction>("segmentScissorsTool")->trigger();
  const std::vector<QPoint> corners = outlineAt(w.showOfPet({-6, 2, 1}), 50);
  const Workspace before = w.workspace();
  const int steps = w.steps();
  const SeenPart seen = w.inside(corners);
  QTest::mousePress(w.view(), Qt::LeftButton, {}, corners.front());
  for (const QPoint p : corners) QTest::mouseEvent(QTest::MouseMove, w.view(), Qt::LeftButton, {}, p);
  QTest::mouseRelease(w.view(), Qt::LeftButton, {}, corners.back());
  QVERIFY(w.idle());
  QVERIFY2(w.said().isEmpty(), qPrintable(w.said()));
  QCOMPARE(w.steps(), steps + 1);
  const BitMask left = subtracted(own, seen.inside);
  QVERIFY(!left.empty() && left != own);
  QVERIFY(seen.leaves(w.mask(1), left));
  const RecordedRecipe recorded = recordedRecipe(*w.map(), {});
  const auto again = follow(recorded.recipe, *w.session().series()->volume);
  QVERIFY(recorded.missing.empty() && again && maskOf(again->labels, 1) == w.mask(1));
  w.undo();
  QVERIFY(w.isAs(before));
}

// The clicked position is in the range where it is seen, not at its coordinates in the CT.
void TestFusedPainting::itsConnectedPartIsTaken() {
  QFETCH(Rigid, petFromCt);
  FusedPaintWindow w(petFromCt);
  w.click("segmentFromCurve");
  w.child<QDoubleSpinBox>("segmentLow")->setValue(1.6);
  w.child<QDoubleSpinBox>("segmentHigh")->setValue(5);
  w.child<QAction>("partTool")->trigger();
  const glm::dvec3 clicked(-8, 0, 0);
  const VoxelGeometry& grid = w.grid();
  const Volume& volume = *w.session().series()->volume;
  const auto isInRange = [&](glm::ivec3 voxel) { return volume.value(voxel.x, voxel.y, voxel.z) >= 320; };
  QVERIFY(petFromCt == Rigid{} ||
          !isInRange(glm::ivec3(glm::round(grid.voxelFromPatient(petFromCt.inverse()(clicked))))));
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, w.showOfPet(clicked));
  QVERIFY(w.idle());
  QVERIFY2(w.said().isEmpty(), qPrintable(w.said()));
  QCOMPARE(w.count(), std::size_t(1));
  const BitMask expected = w.voxelsOf(isInRange);
  QVERIFY(!expected.empty() && w.mask(1) == expected);
}

void TestFusedPainting::withoutTheOverlayTheCtIsNotChanged_data() {
  QTest::addColumn<QByteArray>("tool");
  for (const char* tool :
       {"paintTool", "outlineTool", "smartBrushTool", "levelTraceTool", "segmentScissorsTool", "partTool"})
    QTest::newRow(tool) << QByteArray(tool);
}

// Slices show the CT alone, and the panel belongs to the PET in 3D.
void TestFusedPainting::withoutTheOverlayTheCtIsNotChanged() {
  QFETCH(QByteArray, tool);
  FusedPaintWindow w;
  QVERIFY(w.make(1.6, 5));
  w.session().change(QStringLiteral("alone"), withOverlay(w.workspace(), axialViewId, nullptr));
  w.session().endGesture();
  w.child<QAction>(tool.constData())->trigger();
  const QPoint at = w.showOfPet({10, 0, 0});  // at the edge of the PET's ball
  const Workspace before = w.workspace();
  if (tool == "outlineTool" || tool == "segmentScissorsTool") {
    for (const QPoint corner : outlineAt(at, 40)) QTest::mouseClick(w.view(), Qt::LeftButton, {}, corner);
    QTest::keyClick(w.view(), Qt::Key_Return);
  } else {
    QTest::mouseClick(w.view(), Qt::LeftButton, {}, at);
  }
  QVERIFY(w.idle());
  QVERIFY2(w.said().contains(QStringLiteral("The panel Segments is about another series: click into a view")),
           qPrintable(w.said()));
  QVERIFY(w.isAs(before));
}

VOLUMEN_TEST(TestFusedPainting);
#include "tst_fused_painting.moc"
