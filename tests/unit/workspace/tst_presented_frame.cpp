// Guards slices.md 2 and window.md "Show frames as acquired" for frames turned by a presentation state. Each
// displayed pixel follows the standard's order of rotation and mirroring. The letters of PatientOrientation
// turn with the picture.
#include "tests/unit/suite.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/presented_frame.h"

using namespace volumen;

class TestPresentedFrame : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theDisplayedAreaFillsTheView_data();
  void theDisplayedAreaFillsTheView();
  void annotationsLieOnTheirPixels();
  void lettersTurn_data();
  void lettersTurn();
};

namespace {

// Returns 6 x 4 pixels of 2 x 3 mm. Rows run to the left, columns to posterior-inferior.
LoadedFramePtr turnedFrame(const FramePresentation& how) {
  Frame frame;
  frame.size = {6, 4};
  std::vector<float> values(24, 0);
  values[1] = 1;
  frame.values = values;
  frame.greys = {{"", {{0.5, 1}, WindowFunction::linear, {}, false}, false}};
  frame.pixel = {{2, 3}, PixelSizeKind::atDetector};
  frame.rowSide = "L";
  frame.columnSide = "PI";
  Series series;
  series.format = "DICOM";
  return *shownFrame(series, {keyOf(series), 0, "pr"}, frame, how);
}

SlicePlane planeOf(const LoadedFrame& frame, glm::ivec2 pixels) {
  ViewState view;
  view.kind = ViewKind::frames;
  const FlatLook look;
  return presentedPlane(frame, look, flatPlane(view, look, frame.geometry(), {}, pixels));
}

FramePresentation turnedBy(int quarters, bool mirrored, std::optional<PixelBox> area = {}) {
  FramePresentation how;
  how.turn = {quarters, mirrored};
  how.area = area;
  return how;
}

}  // namespace

void TestPresentedFrame::theDisplayedAreaFillsTheView_data() {
  QTest::addColumn<int>("quarters");
  QTest::addColumn<bool>("mirrored");
  QTest::addColumn<bool>("part");
  for (int quarters = 0; quarters < 4; ++quarters)
    for (const bool mirrored : {false, true})
      for (const bool part : {false, true})
        QTest::addRow("%d quarters%s%s", quarters, mirrored ? ", mirrored" : "", part ? ", a part" : "")
            << quarters << mirrored << part;
}

void TestPresentedFrame::theDisplayedAreaFillsTheView() {
  QFETCH(int, quarters);
  QFETCH(bool, mirrored);
  QFETCH(bool, part);
  const auto area = part ? std::optional(PixelBox{{1, 2}, {7, 3}}) : std::nullopt;
  const LoadedFramePtr frame = turnedFrame(turnedBy(quarters, mirrored, area));
  const PresentedGrid grid(*frame->how, {6, 4});
  const glm::dvec2 mm = quarters % 2 == 0 ? glm::dvec2(2, 3) : glm::dvec2(3, 2);
  const glm::dvec2 wholeMm = glm::dvec2(grid.size()) * mm;
  const SlicePlane plane = planeOf(*frame, {600, 600});
  QCOMPARE(plane.mmPerPixel, std::max(wholeMm.x, wholeMm.y) / 600);
  for (int y = 0; y < grid.size().y; ++y)
    for (int x = 0; x < grid.size().x; ++x) {
      const glm::dvec2 fromMiddle = (glm::dvec2(x, y) + 0.5) * mm - wholeMm / 2.0;
      const glm::dvec3 p = plane.patientFromPixel(glm::dvec2(300, 300) + fromMiddle / plane.mmPerPixel);
      const glm::dvec3 pVoxel = frame->geometry().voxelFromPatient(p);
      QCOMPARE(glm::ivec2(glm::round(glm::dvec2(pVoxel))), grid.pixelAt({x, y}));
    }
}

void TestPresentedFrame::annotationsLieOnTheirPixels() {
  const LoadedFramePtr frame = turnedFrame(turnedBy(1, true, PixelBox{{1, 2}, {7, 3}}));
  // The outer corner of the first pixel, before the turn.
  const glm::dvec3 corner =
      frame->geometry().voxelFromPatient(annotationPlace(*frame, {0, 0}, AnnotationUnits::pixel));
  QVERIFY(glm::distance(glm::dvec2(corner), glm::dvec2(-0.5)) < 1e-9);
  // The middle of the displayed area.
  const glm::dvec3 middle =
      frame->geometry().voxelFromPatient(annotationPlace(*frame, {0.5, 0.5}, AnnotationUnits::display));
  QVERIFY(glm::distance(glm::dvec2(middle), glm::dvec2(4, 2.5)) < 1e-9);
}

void TestPresentedFrame::lettersTurn_data() {
  QTest::addColumn<int>("quarters");
  QTest::addColumn<bool>("mirrored");
  QTest::addColumn<QString>("right");
  QTest::addColumn<QString>("bottom");
  const auto row = [](const char* name, int quarters, bool mirrored, const char* right, const char* bottom) {
    QTest::newRow(name) << quarters << mirrored << QString::fromLatin1(right) << QString::fromLatin1(bottom);
  };
  row("as acquired", 0, false, "L", "PI");
  row("a quarter clockwise", 1, false, "AS", "L");
  row("half a turn", 2, false, "R", "AS");
  row("three quarters", 3, false, "PI", "R");
  row("mirrored", 0, true, "R", "PI");
  row("a quarter, then mirrored", 1, true, "PI", "L");
}

void TestPresentedFrame::lettersTurn() {
  QFETCH(int, quarters);
  QFETCH(bool, mirrored);
  QFETCH(QString, right);
  QFETCH(QString, bottom);
  const LoadedFramePtr frame = turnedFrame(turnedBy(quarters, mirrored));
  const SlicePlane plane = planeOf(*frame, {600, 600});
  QCOMPARE(QString::fromStdString(frameSide(*frame, plane.right)), right);
  QCOMPARE(QString::fromStdString(frameSide(*frame, plane.down)), bottom);
}

VOLUMEN_TEST(TestPresentedFrame);
#include "tst_presented_frame.moc"
