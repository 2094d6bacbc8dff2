// Guards how segments are drawn in slices, against a reference model that follows the definition sample by
// sample. Closed forms cover straight borders at any angle, voxel faces, a ball, thin structures and touching
// labels.
#include <tbb/global_control.h>

#include <QImage>

#include "tests/fixtures/seeds.h"
#include "tests/ui/chance_slices.h"
#include "tests/ui/place_twin.h"
#include "tests/unit/suite.h"
#include "ui/controller/segment_layer.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr QRgb redLabel = qRgb(255, 0, 0), blueLabel = qRgb(0, 0, 255), black = qRgb(0, 0, 0);
constexpr auto nearest = Interpolation::nearest, linear = Interpolation::linear;

// Returns a layer in which `labelOf` gives each voxel its label. Label 1 is shown, in red.
template <class LabelOf>
SegmentLayer redLayer(glm::ivec3 size, const LabelOf& labelOf) {
  VoxelGeometry grid;
  grid.size = size;
  LabelEdit edit{LabelMap(grid)};
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) edit.set({i, j, k}, std::uint8_t(labelOf({i, j, k})));
  SegmentLayer layer;
  layer.labels = std::make_shared<const LabelMap>(edit.done());
  layer.shown = {{1, redLabel, 1}};
  return layer;
}

SlicePlane turnedPlane(glm::dvec3 centre, double mm, double degrees, Interpolation interpolation) {
  const double turned = degrees * 3.14159265358979 / 180;
  SlicePlane plane;
  plane.centre = centre;
  plane.right = {std::cos(turned), std::sin(turned), 0};
  plane.down = {-std::sin(turned), std::cos(turned), 0};
  plane.mmPerPixel = mm;
  plane.size = {60, 50};
  plane.interpolation = interpolation;
  return plane;
}

QImage segmentsOver(QRgb under, const SlicePlane& plane, const SegmentLayer& layer) {
  QImage picture(plane.size.x, plane.size.y, QImage::Format_RGB32);
  picture.fill(under);
  return withSegments(picture, plane, layer);
}

// Returns the part of a unit square where x * normal.x + y * normal.y < distance from its centre.
double partOfPixel(glm::dvec2 normal, double distance) {
  const double a = std::max(std::abs(normal.x), std::abs(normal.y)),
               b = std::min(std::abs(normal.x), std::abs(normal.y)), d = std::abs(distance);
  if (d >= (a + b) / 2) return distance > 0 ? 1 : 0;
  const double larger =
      d <= (a - b) / 2 ? 0.5 + d / a : 1 - ((a + b) / 2 - d) * ((a + b) / 2 - d) / (2 * a * b);
  return distance > 0 ? larger : 1 - larger;
}

void addZoomRows(const std::vector<double>& mms) {
  QTest::addColumn<double>("mm");
  QTest::addColumn<Interpolation>("interpolation");
  for (const double mm : mms)
    for (const auto interpolation : {nearest, linear})
      QTest::addRow("%g mm a pixel, %s", mm, interpolation == nearest ? "nearest" : "linear")
          << mm << interpolation;
}

}  // namespace

class TestLabelPicture : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void pixelsAreThoseOfATwin_data();
  void pixelsAreThoseOfATwin();
  void planesOfVoxelsAreThoseOfATwin_data();
  void planesOfVoxelsAreThoseOfATwin();
  void mostPixelsWereCompared();
  void tiltedBordersCoverTheirPart_data() { addZoomRows({0.13, 0.6, 1.0, 1.3, 2.4, 5}); }
  void tiltedBordersCoverTheirPart();
  void nearestVoxelsAreDrawnToTheirFaces();
  void aBallIsRoundWhereItIsInterpolated();
  void thinThingsAreSeenAtAnyZoom_data() { addZoomRows({0.125, 0.5, 0.9, 1.0, 1.4, 2.3, 5.0}); }
  void thinThingsAreSeenAtAnyZoom();
  void labelsThatTouchLeaveNoSeam_data() { addZoomRows({0.07, 0.3, 1.0, 1.7}); }
  void labelsThatTouchLeaveNoSeam();
  void oneThreadDrawsTheSame();

 private:
  void compareWithTwin(const SlicePlane& plane, const SegmentLayer& layer);

  std::int64_t pixels_ = 0, unsure_ = 0;
};

void TestLabelPicture::pixelsAreThoseOfATwin_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(30, 1000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

void TestLabelPicture::pixelsAreThoseOfATwin() {
  QFETCH(int, seed);
  Chance chance{std::uint64_t(seed)};
  const VoxelGeometry grid = shearedRamp(0)->geometry();
  SlicePlane plane = chancePlane(chance);
  plane.interpolation = chance.oneIn(2) ? nearest : linear;
  const SegmentLayer layer = chanceSegments(chance, grid);
  compareWithTwin(plane, layer);
}

// Planes lie across each axis: at voxel centres, beside and between them, and beyond the outermost.
void TestLabelPicture::planesOfVoxelsAreThoseOfATwin_data() {
  QTest::addColumn<int>("across");
  QTest::addColumn<double>("at");
  for (int across = 0; across < 3; ++across)
    for (const double at : {0.0, 20.0, 31.0, 32.0, 20 + 1e-9, 20 - 1e-9, 20.001, 19.999, 31.3, 20.5, -0.4})
      QTest::addRow("across %c at %.10g", "ijk"[across], at) << across << at;
}

// The other two axes lie along the picture's sides in either order, and flipped.
void TestLabelPicture::planesOfVoxelsAreThoseOfATwin() {
  QFETCH(int, across);
  QFETCH(double, at);
  VoxelGeometry grid;
  grid.size = rampSize;
  grid.patientFromVoxelStep = glm::dmat3(0, 1.1, 0, 0, 0, -0.8, 1.7, 0, 0);
  for (int turn = 0; turn < 8; ++turn) {
    Chance chance{std::uint64_t(turn)};
    const int along = (across + 1 + turn % 2) % 3, down = 3 - across - along;
    glm::dvec3 vCentre(chance.between(15, 25), chance.between(15, 25), chance.between(15, 25));
    vCentre[across] = at;
    SlicePlane plane;
    plane.centre = grid.patientFromVoxel(vCentre);
    plane.right = glm::normalize(grid.patientFromVoxelStep[along]) * (turn & 2 ? 1.0 : -1.0);
    plane.down = glm::normalize(grid.patientFromVoxelStep[down]) * (turn & 4 ? 1.0 : -1.0);
    plane.mmPerPixel = chance.between(0.3, 2);
    plane.size = {45, 35};
    compareWithTwin(plane, chanceSegments(chance, grid));
  }
}

void TestLabelPicture::compareWithTwin(const SlicePlane& plane, const SegmentLayer& layer) {
  const QImage picture = segmentsOver(qRgb(100, 100, 100), plane, layer);
  const PlaceTwin twin(layer, plane);
  int unsure = 0;
  for (int y = 0; y < plane.size.y; ++y)
    for (int x = 0; x < plane.size.x; ++x) {
      if (!twin.isSure(x, y)) {
        ++unsure;
        continue;
      }
      const QRgb seen = picture.pixel(x, y);
      const glm::dvec3 off =
          glm::abs(twin.colour(x, y, glm::dvec3(100)) - glm::dvec3(qRed(seen), qGreen(seen), qBlue(seen)));
      QVERIFY2(std::max({off.x, off.y, off.z}) < 0.51,
               qPrintable(QStringLiteral("%1 %2: %3 %4 %5").arg(x).arg(y).arg(off.x).arg(off.y).arg(off.z)));
    }
  pixels_ += plane.size.x * plane.size.y;
  unsure_ += unsure;
}

// Few pixels may be unsure, even in small pictures of large pixels with hundreds of samples each.
void TestLabelPicture::mostPixelsWereCompared() {
  QVERIFY2(5 * unsure_ <= pixels_, qPrintable(QStringLiteral("%1 of %2").arg(unsure_).arg(pixels_)));
}

// A half-space is turned by any angle. Five samples are off by at most 0.29, and by 0.075 in the mean square.
void TestLabelPicture::tiltedBordersCoverTheirPart() {
  QFETCH(double, mm);
  QFETCH(Interpolation, interpolation);
  SegmentLayer layer = redLayer({240, 200, 2}, [](glm::ivec3 voxel) { return voxel.x < 120 ? 1 : 0; });
  layer.opacity = 1;
  double most = 0, squares = 0;
  int pixels = 0;
  for (int degrees = 1; degrees < 180; degrees += 3) {
    const SlicePlane plane = turnedPlane({119.5 - 0.27 * mm, 100, 0.25}, mm, degrees, interpolation);
    const QImage picture = segmentsOver(black, plane, layer);
    for (int y = 15; y < 35; ++y)
      for (int x = 15; x < 45; ++x) {
        const double distance = (119.5 - plane.patientFromPixel({x + 0.5, y + 0.5}).x) / mm;
        if (std::abs(distance) > 0.75) continue;
        const double off = std::abs(qRed(picture.pixel(x, y)) / 255.0 -
                                    partOfPixel({plane.right.x, plane.down.x}, distance));
        most = std::max(most, off), squares += off * off, ++pixels;
      }
  }
  QVERIFY(pixels > 500);
  QVERIFY2(most < 0.295, qPrintable(QString::number(most)));
  QVERIFY2(std::sqrt(squares / pixels) < 0.08, qPrintable(QString::number(std::sqrt(squares / pixels))));
}

// Two adjacent voxels, eight pixels wide each, have an outline of one pixel.
void TestLabelPicture::nearestVoxelsAreDrawnToTheirFaces() {
  SegmentLayer layer =
      redLayer(glm::ivec3(9), [](glm::ivec3 v) { return v == glm::ivec3(4) || v == glm::ivec3(5, 4, 4); });
  layer.opacity = 0.4;
  SlicePlane plane = turnedPlane(glm::dvec3(4), 0.125, 0, nearest);
  plane.size = {40, 40};
  const QImage picture = segmentsOver(black, plane, layer);
  const QRect voxels(16, 16, 16, 8), inside = voxels.adjusted(1, 1, -1, -1);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x)
      QCOMPARE(picture.pixel(x, y), inside.contains(x, y)   ? qRgb(102, 0, 0)
                                    : voxels.contains(x, y) ? qRgb(204, 0, 0)
                                                            : black);
}

// A ball of 9.3 voxels with ten pixels per voxel. No border is farther than half a voxel diagonal from the
// sphere's, and its area is that of a circle. The outline is about as long as the circle, so it has no
// corners.
void TestLabelPicture::aBallIsRoundWhereItIsInterpolated() {
  constexpr double radius = 9.3, mm = 0.1, pi = 3.14159265358979;
  SegmentLayer layer = redLayer(
      glm::ivec3(25), [](glm::ivec3 voxel) { return glm::length(glm::dvec3(voxel) - 12.0) < radius; });
  SlicePlane plane = turnedPlane(glm::dvec3(12), mm, 20, linear);
  plane.size = {240, 240};
  layer.opacity = 1;
  const QImage whole = segmentsOver(black, plane, layer);
  double area = 0;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 240; ++x) {
      const double from = glm::length(plane.patientFromPixel({x + 0.5, y + 0.5}) - 12.0),
                   part = qRed(whole.pixel(x, y)) / 255.0;
      QVERIFY2(from > radius - 0.9 || part == 1, qPrintable(QString::number(from)));
      QVERIFY2(from < radius + 0.9 || part == 0, qPrintable(QString::number(from)));
      area += part * mm * mm;
    }
  QVERIFY2(std::abs(area / (pi * radius * radius) - 1) < 0.03, qPrintable(QString::number(area)));
  // Outlines are complete: with opacity 1/2 instead of 1, only the inside is lighter.
  layer.opacity = 0.5;
  const QImage half = segmentsOver(black, plane, layer);
  double outline = 0;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 240; ++x)
      outline += (2.0 * qRed(half.pixel(x, y)) - qRed(whole.pixel(x, y))) / 255.0 * mm;
  QVERIFY2(outline > 2 * pi * radius && outline < 2 * pi * radius * 1.6,
           qPrintable(QString::number(outline)));
}

// A single voxel has half a pixel of outline somewhere. A line of voxels has half its width all along.
void TestLabelPicture::thinThingsAreSeenAtAnyZoom() {
  QFETCH(double, mm);
  QFETCH(Interpolation, interpolation);
  constexpr int middle = 150;
  SegmentLayer voxel =
      redLayer({2 * middle, 2 * middle, 3}, [](glm::ivec3 v) { return v == glm::ivec3(middle, middle, 1); });
  SegmentLayer line =
      redLayer({2 * middle, 2 * middle, 3}, [](glm::ivec3 v) { return v.y == middle && v.z == 1; });
  voxel.opacity = line.opacity = 0.5;
  Chance chance{3};
  for (int n = 0; n < 30; ++n) {
    const glm::dvec3 by = mm * chance.vector();
    const SlicePlane plane =
        turnedPlane({middle + by.x, middle + by.y, 1}, mm, chance.between(0, 180), interpolation);
    const QImage one = segmentsOver(black, plane, voxel), many = segmentsOver(black, plane, line);
    const auto strongest = [](const QImage& picture, glm::dvec2 p) {
      int most = 0;
      for (int y = int(p.y) - 1; y <= int(p.y) + 1; ++y)
        for (int x = int(p.x) - 1; x <= int(p.x) + 1; ++x) most = std::max(most, qRed(picture.pixel(x, y)));
      return most;
    };
    const double half = 0.47 * 255, ofWidth = std::min(half, 0.5 / mm * 255);
    QVERIFY(strongest(one, plane.pixelFromPatient({middle, middle, 1})) > half);
    for (double x = -15 * mm; x < 15 * mm; x += 0.5 * mm)
      QVERIFY2(strongest(many, plane.pixelFromPatient({middle + x, middle, 1})) > ofWidth,
               qPrintable(QString::number(x)));
  }
}

// Every voxel has one of three labels at random, so the whole picture is coloured.
void TestLabelPicture::labelsThatTouchLeaveNoSeam() {
  QFETCH(double, mm);
  QFETCH(Interpolation, interpolation);
  Chance chance{7};
  SegmentLayer layer = redLayer(glm::ivec3(100), [&](glm::ivec3) { return 1 + chance.below(3); });
  layer.shown = {{1, blueLabel, 1}, {2, blueLabel, 1}, {3, blueLabel, 1}};
  layer.opacity = 1;
  SlicePlane plane = turnedPlane(glm::dvec3(49.37), mm, 31, interpolation);
  plane.down = glm::normalize(glm::cross(glm::normalize(glm::dvec3(0.1, 0.2, 1)), plane.right));
  plane.size = {40, 40};
  QImage all(40, 40, QImage::Format_RGB32);
  all.fill(blueLabel);
  QVERIFY(segmentsOver(qRgb(255, 255, 255), plane, layer) == all);
}

void TestLabelPicture::oneThreadDrawsTheSame() {
  Chance chance{5};
  const VoxelGeometry grid = shearedRamp(0)->geometry();
  for (int n = 0; n < 10; ++n) {
    SlicePlane plane = chancePlane(chance);
    plane.size = {90, 80};
    const SegmentLayer layer = chanceSegments(chance, grid);
    const QImage many = segmentsOver(black, plane, layer);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    QVERIFY(segmentsOver(black, plane, layer) == many);
  }
}

VOLUMEN_TEST(TestLabelPicture);
#include "tst_label_picture.moc"
