// Guards export/contour_segments.h: contours of any program are filled by even-odd on the slices of a series,
// and what pixels cannot hold is told.
#include <cmath>

#include "io/export/contour_segments.h"
#include "io/export/read_segments.h"
#include "io/export/rtstruct.h"
#include "tests/unit/io/segmentation_slices.h"
#include "tests/unit/io/study_sources.h"
#include "tests/unit/suite.h"
#include "viewer/slice/plane.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

RegionOfInterest square(double low, double high, double z, const VoxelGeometry& grid) {
  RegionOfInterest region;
  region.name = "Square";
  Contour contour;
  for (const glm::dvec2 p : {glm::dvec2(low, low), {high, low}, {high, high}, {low, high}})
    contour.points.push_back(grid.patientFromVoxel({p, z}));
  region.contours.push_back(contour);
  return region;
}

VoxelGeometry someGrid() {
  VoxelGeometry grid;
  grid.size = {10, 10, 8};
  grid.patientFromVoxelStep = glm::dmat3(0.5, 0, 0, 0, 0.5, 0, 0, 0, 2);
  return grid;
}

std::int64_t pixelsIn(const Segmentation& s) {
  std::int64_t count = 0;
  for (std::size_t n = 0; n < s.segments.size(); ++n) count += pixelsOf(s, n);
  return count;
}

}  // namespace

class TestContourSegments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void contoursOfOthersAreFilled_data();
  void contoursOfOthersAreFilled();
  void contoursOnOtherPlanesAreAsThickAsTheirDistance();
  void structureSetsOfOthersAreRead();
  void ofAnotherSpaceOrWithoutGridIsRefused();
};

void TestContourSegments::contoursOfOthersAreFilled_data() {
  QTest::addColumn<QList<double>>("squares");  // low and high of each, in pixels
  QTest::addColumn<double>("z");
  QTest::addColumn<int>("pixels");
  QTest::addColumn<QByteArray>("note");
  QTest::newRow("a square around centres") << QList<double>{1.5, 4.5} << 3.0 << 9 << QByteArray();
  QTest::newRow("a square inside another is a hole")
      << QList<double>{0.5, 5.5, 2.5, 3.5} << 3.0 << 24 << QByteArray();
  QTest::newRow("beside each other") << QList<double>{0.5, 2.5, 5.5, 8.5} << 3.0 << 4 + 9 << QByteArray();
  QTest::newRow("larger than its pixels")
      << QList<double>{1.1, 3.9} << 3.0 << 4
      << QByteArray("enclose 0.00392 ml; the pixels whose centres lie inside are 0.002 ml");
  QTest::newRow("between two centres") << QList<double>{1.2, 1.8} << 3.0 << 0 << QByteArray("are 0 ml");
  QTest::newRow("partly outside the pictures")
      << QList<double>{7.5, 29.5} << 3.0 << 4 << QByteArray("are 0.002 ml");
}

void TestContourSegments::contoursOfOthersAreFilled() {
  QFETCH(QList<double>, squares);
  QFETCH(double, z);
  QFETCH(int, pixels);
  QFETCH(QByteArray, note);
  const VoxelGeometry grid = someGrid();
  StructureSet set;
  set.regions.push_back(square(squares[0], squares[1], z, grid));
  if (squares.size() > 2)
    set.regions[0].contours.push_back(square(squares[2], squares[3], z, grid).contours[0]);
  const Segmentation filled = filledContours(set, grid);
  QCOMPARE(int(pixelsIn(filled)), pixels);
  QCOMPARE(filled.thickness, 2.0);
  QCOMPARE(filled.notes.size(), std::size_t(note.isEmpty() ? 0 : 1));
  if (!note.isEmpty()) QVERIFY2(isSaid(filled.notes, note.constData()), filled.notes[0].c_str());
}

void TestContourSegments::contoursOnOtherPlanesAreAsThickAsTheirDistance() {
  const VoxelGeometry grid = someGrid();
  StructureSet set;
  set.regions.push_back(square(1.5, 4.5, 0.75, grid));
  for (const double z : {2.25, 3.75, 5.25})
    set.regions[0].contours.push_back(square(1.5, 4.5, z, grid).contours[0]);
  const Segmentation filled = filledContours(set, grid);
  QCOMPARE(filled.thickness, 3.0);
  const BitMask mask = maskOf(filled, 0, grid);
  for (int k = 0; k < 8; ++k) QCOMPARE(mask.at({2, 2, k}), k <= 6);
  // On slices, every second one: nothing between them, and that is told.
  set.regions = {square(1.5, 4.5, 1, grid)};
  for (const double z : {3.0, 5.0}) set.regions[0].contours.push_back(square(1.5, 4.5, z, grid).contours[0]);
  const Segmentation sparse = filledContours(set, grid);
  for (int k = 0; k < 8; ++k) QCOMPARE(maskOf(sparse, 0, grid).at({2, 2, k}), k == 1 || k == 3 || k == 5);
  QVERIFY(isSaid(sparse.notes, "No two neighbouring slices"));
  // Points, lines and outlines across the slices have no pixels.
  set.regions = {square(1.5, 4.5, 1, grid), square(1.5, 4.5, 2, grid)};
  set.regions[0].contours[0].type = Contour::Type::openPlanar;
  set.regions[1].contours[0].points[2].z += 4;
  const Segmentation none = filledContours(set, grid);
  QVERIFY(none.frames.empty() && none.notes.size() == 2);
}

void TestContourSegments::structureSetsOfOthersAreRead() {
  NEED_DATA(dataPath());
  const Series series = seriesAt(dataPath("pet-ct/sts019-ct"));
  const std::string path = dataPath("pet-ct/sts019-rtstruct-ct.dcm");
  const auto out = readSegments(path, series, series.regular ? series.regular->geometry : series.acquired);
  QVERIFY2(out, out ? "" : out.message().c_str());
  const auto set = loadContours(path);
  QVERIFY(set.ok());
  double enclosed = 0, filled = 0;
  for (const RegionOfInterest& region : set->regions)
    for (const Contour& contour : region.contours)
      enclosed += areaOf(contour) * sliceDistance(series.acquired);
  for (const Segmented& map : out->maps)
    filled += double(map.labels.geometry().voxelCount() - labelCounts(map.labels)[0]) *
              map.labels.geometry().voxelVolume();
  QVERIFY2(std::abs(filled - enclosed) < 0.05 * enclosed,
           qPrintable(QStringLiteral("%1 mm^3 became %2").arg(enclosed).arg(filled)));
}

void TestContourSegments::ofAnotherSpaceOrWithoutGridIsRefused() {
  Chance chance(4);
  const Slices slices({9, 7}, even(4, 2.5), chance);
  const std::string path = slices.folder.path("rt.dcm");
  Segmented in{{{.number = 1, .label = "a"}}, LabelMap(slices.grid)};
  in.labels = withLabel(in.labels, 1, inverted(BitMask(slices.grid)));
  QVERIFY(writeStructureSet({&in, 1}, slices.series, {}, path).ok());
  Series other = slices.series;
  other.frameOfReferenceUid = "1.9";
  QVERIFY2(readSegments(path, other, slices.grid).ok(), "it names pictures of the series");
  other.sopInstanceUids = {"1.2"};
  const auto elsewhere = readSegments(path, other, slices.grid);
  QVERIFY(!elsewhere && elsewhere.message().find("another frame of reference") != std::string::npos);
  const auto own = readSegments(path);
  QVERIFY(!own && own.message().find("no grid of their own") != std::string::npos);
}

VOLUMEN_TEST(TestContourSegments);
#include "tst_contour_segments.moc"
