// Guards facing mammograms: the side of the chest wall, its position at the requested edge, and a common
// scale.
#include "tests/unit/suite.h"
#include "ui/workspace/facing.h"
#include "ui/workspace/flat_plane.h"

using namespace volumen;

namespace {

// Returns `columns` x 20 pixels of `mm` with one value in the left half and another in the right half.
LoadedFramePtr breastFrame(const char* rows, float leftHalf, float rightHalf, int columns = 10, double mm = 1,
                           bool inverted = false, PixelSizeKind kind = PixelSizeKind::atDetector,
                           const char* columnsTo = "", const char* side = "") {
  Frame frame;
  frame.size = {columns, 20};
  std::vector<float> values;
  for (int n = 0; n < columns * 20; ++n) values.push_back(n % columns < columns / 2 ? leftHalf : rightHalf);
  frame.values = values;
  frame.greys = {{"", {{500, 1000}, WindowFunction::linear, {}, inverted}, false}};
  frame.pixel = {{mm, mm}, kind};
  frame.rowSide = rows;
  frame.columnSide = columnsTo;
  Series series;
  series.laterality = side;
  series.path = "breast";
  series.acquired.size = {columns, 20, 1};
  series.acquired.calibrated = false;
  return *shownFrame(series, {keyOf(series), 0}, frame);
}

}  // namespace

class TestFacing : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theChestWallIsFound_data();
  void theChestWallIsFound();
  void framesFaceEachOther_data();
  void framesFaceEachOther();
  void breastsAreUpright_data();
  void breastsAreUpright();
  void framesWithoutMmHaveNoScale();
};

void TestFacing::theChestWallIsFound_data() {
  QTest::addColumn<QByteArray>("rows");  // direction of the rows
  QTest::addColumn<float>("leftHalf");
  QTest::addColumn<float>("rightHalf");
  QTest::addColumn<bool>("inverted");
  QTest::addColumn<int>("wall");
  const auto row = [](const char* name, const char* rows, float leftHalf, float rightHalf, bool inverted,
                      ChestWall wall) {
    QTest::newRow(name) << QByteArray(rows) << leftHalf << rightHalf << inverted << int(wall);
  };
  row("rows lead to the back", "P", 900, 10, false, ChestWall::right);
  row("rows lead to the front", "A", 10, 900, false, ChestWall::left);
  row("to the front and left", "AL", 10, 900, false, ChestWall::left);
  row("by the tissue, left", "", 900, 10, false, ChestWall::left);
  row("by the tissue, right", "", 10, 900, false, ChestWall::right);
  row("by the tissue, dark is bright", "", 900, 10, true, ChestWall::right);
  row("across", "L", 10, 900, false, ChestWall::right);
  row("both sides alike", "", 500, 500, false, ChestWall::anywhere);
}

void TestFacing::theChestWallIsFound() {
  QFETCH(QByteArray, rows);
  QFETCH(float, leftHalf);
  QFETCH(float, rightHalf);
  QFETCH(bool, inverted);
  QFETCH(int, wall);
  QCOMPARE(int(chestWallOf(*breastFrame(rows.constData(), leftHalf, rightHalf, 10, 1, inverted))), wall);
}

void TestFacing::framesFaceEachOther_data() {
  QTest::addColumn<bool>("sameScale");
  QTest::newRow("the same scale") << true;
  QTest::newRow("each as large as its view") << false;
}

void TestFacing::framesFaceEachOther() {
  QFETCH(bool, sameScale);
  // One picture has 10 x 20 mm. The other has 30 x 40 mm and is mirrored.
  const std::vector<FacingFrame> frames{
      {breastFrame("P", 10, 900), {}, {300, 200}, ChestWall::right},
      {breastFrame("P", 10, 900, 15, 2), {.inverted = true}, {300, 200}, ChestWall::left}};
  const std::vector<FlatLook> looks = facingLooks(frames, sameScale);
  QCOMPARE(looks.size(), std::size_t(2));
  QVERIFY(!looks[0].turn.mirrored && looks[1].turn.mirrored);
  QVERIFY2(looks[1].inverted, "what it was beside");
  ViewState state;
  state.kind = ViewKind::frames;
  for (std::size_t n = 0; n < 2; ++n) {
    const VoxelGeometry& geometry = frames[n].frame->geometry();
    const SlicePlane plane = flatPlane(state, looks[n], geometry, {}, frames[n].pixels);
    // 40 mm cover 200 pixels, or 20 mm do.
    QCOMPARE(plane.mmPerPixel, sameScale || n == 1 ? 0.2 : 0.1);
    // Rows lead to the chest wall in both pictures. This is the outer edge of its column.
    const double edge = geometry.size.x - 0.5;
    const glm::dvec2 wall = plane.pixelFromPatient(geometry.patientFromVoxel({edge, 9.5, 0}));
    QVERIFY2(std::abs(wall.x - (n == 0 ? 300 : 0)) < 1e-6, qPrintable(QString::number(wall.x)));
    QVERIFY(std::abs(wall.y - 100) < 1e-6);
  }
  const std::vector<FlatLook> free = facingLooks({{frames[0].frame, {}, {300, 200}}}, sameScale);
  QVERIFY(free[0] == FlatLook());
}

void TestFacing::breastsAreUpright_data() {
  QTest::addColumn<QByteArray>("rows");
  QTest::addColumn<QByteArray>("columns");
  QTest::addColumn<QByteArray>("side");
  QTest::addColumn<int>("wanted");
  QTest::addColumn<int>("quarters");
  QTest::addColumn<bool>("mirrored");
  const auto row = [](const char* name, const char* rows, const char* columns, const char* side,
                      ChestWall wanted, PictureTurn turn) {
    QTest::newRow(name) << QByteArray(rows) << QByteArray(columns) << QByteArray(side) << int(wanted)
                        << turn.quarters << turn.mirrored;
  };
  const ChestWall left = ChestWall::left, right = ChestWall::right;
  row("R CC as it hangs", "P", "L", "R", right, {});
  row("L CC as it hangs", "A", "R", "L", left, {});
  row("L CC, half a turn", "P", "L", "L", left, {2, false});
  row("R CC, half a turn", "A", "R", "R", right, {2, false});
  row("L CC seen from below", "P", "R", "L", left, {0, true});
  row("L CC top to bottom", "A", "L", "L", left, {2, true});
  row("R MLO as it hangs", "P", "IL", "R", right, {});
  row("L MLO, half a turn", "P", "SL", "L", left, {2, false});
  row("L MLO, left to right", "P", "IR", "L", left, {0, true});
  row("no side", "P", "L", "", left, {0, true});
  row("no columns", "P", "", "L", left, {0, true});
}

void TestFacing::breastsAreUpright() {
  QFETCH(QByteArray, rows);
  QFETCH(QByteArray, columns);
  QFETCH(QByteArray, side);
  QFETCH(int, wanted);
  QFETCH(int, quarters);
  QFETCH(bool, mirrored);
  const ChestWall edge = ChestWall(wanted);
  const LoadedFramePtr frame = breastFrame(rows.constData(), 10, 900, 10, 1, false, PixelSizeKind::atDetector,
                                           columns.constData(), side.constData());
  const FlatLook look = facingLooks({{frame, {}, {300, 200}, edge}}, false).front();
  QCOMPARE(look.turn.quarters, quarters);
  QCOMPARE(look.turn.mirrored, mirrored);
  // The column at the chest wall is at that edge, however the picture was turned.
  ViewState state;
  state.kind = ViewKind::frames;
  const SlicePlane plane = flatPlane(state, look, frame->geometry(), {}, {300, 200});
  const double column = rows == "P" ? frame->geometry().size.x - 0.5 : -0.5;
  const glm::dvec2 wall = plane.pixelFromPatient(frame->geometry().patientFromVoxel({column, 9.5, 0}));
  QVERIFY(std::abs(wall.x - (edge == ChestWall::right ? 300 : 0)) < 1e-6);
}

// The third frame's pixel size is unknown.
void TestFacing::framesWithoutMmHaveNoScale() {
  const std::vector<FacingFrame> frames{
      {breastFrame("P", 10, 900), {}, {300, 200}},
      {breastFrame("P", 10, 900, 15, 1), {}, {300, 100}},
      {breastFrame("P", 10, 900, 10, 9, false, PixelSizeKind::unknown), {}, {300, 200}}};
  const std::vector<FlatLook> looks = facingLooks(frames, true);
  // 20 mm cover 200 pixels in one view and 100 in the other.
  QCOMPARE(looks[0].zoom, 0.5);
  QCOMPARE(looks[1].zoom, 1.0);
  QCOMPARE(looks[2].zoom, 1.0);
}

VOLUMEN_TEST(TestFacing);
#include "tst_facing.moc"
