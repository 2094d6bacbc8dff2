// Guards slices.md 1: named planes in radiological orientation, their defaults, and steps of the mouse wheel.
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tests/unit/suite.h"
#include "viewer/slice/plane.h"

using namespace volumen;

class TestPlane : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void namedPlanesAreSeenAsRadiologistsDo_data();
  void namedPlanesAreSeenAsRadiologistsDo();
  void theSmallestSizeCoversTheBox_data();
  void theSmallestSizeCoversTheBox();
  void pixelsAndPositionsGoBackAndForth();
  void aVoxelAlongADirection_data();
  void aVoxelAlongADirection();
  void samplesOfSlabsAndPixels_data();
  void samplesOfSlabsAndPixels();
  void aStepOfTheWheel_data();
  void aStepOfTheWheel();
  void onSliceOnlyWhereParallel();
};

namespace {

bool near(glm::dvec3 a, glm::dvec3 b) { return glm::length(a - b) < 1e-9; }

VoxelGeometry geometryOf(glm::ivec3 size, glm::dmat3 L) {
  VoxelGeometry g;
  g.size = size, g.patientFromVoxelStep = L, g.origin = {-10, 20, 30};
  return g;
}

// Returns pixels of 0.7 mm and slices 2 mm apart.
VoxelGeometry axialScan() { return geometryOf({512, 400, 100}, {{0.7, 0, 0}, {0, 0.7, 0}, {0, 0, 2}}); }

const glm::dvec3 oblique = glm::normalize(glm::dvec3(1, 2, 2));

}  // namespace

void TestPlane::namedPlanesAreSeenAsRadiologistsDo_data() {
  QTest::addColumn<int>("name");
  QTest::addColumn<glm::dvec3>("topLeft");  // towards the left and the top of the picture, LPS
  QTest::addColumn<glm::dvec3>("normal");
  QTest::newRow("axial: right on the left, front on top")
      << int(NamedPlane::axial) << glm::dvec3(-1, -1, 0) << glm::dvec3(0, 0, 1);
  QTest::newRow("coronal: right on the left, head on top")
      << int(NamedPlane::coronal) << glm::dvec3(-1, 0, 1) << glm::dvec3(0, 1, 0);
  QTest::newRow("sagittal: front on the left, head on top")
      << int(NamedPlane::sagittal) << glm::dvec3(0, -1, 1) << glm::dvec3(-1, 0, 0);
}

void TestPlane::namedPlanesAreSeenAsRadiologistsDo() {
  QFETCH(int, name);
  QFETCH(glm::dvec3, topLeft);
  QFETCH(glm::dvec3, normal);
  const VoxelGeometry g = axialScan();
  const SlicePlane plane = namedPlane(g, NamedPlane(name));
  QVERIFY(checkPlane(plane).ok());
  QVERIFY(near(plane.centre, g.centre()));
  QCOMPARE(plane.mmPerPixel, 0.7);
  QVERIFY(near(plane.normal(), normal));
  const glm::dvec3 towards = plane.patientFromPixel({0, 0}) - plane.centre;
  QVERIFY(near(glm::sign(glm::round(towards)), topLeft));
}

void TestPlane::theSmallestSizeCoversTheBox_data() {
  QTest::addColumn<int>("name");
  QTest::addColumn<double>("mmPerPixel");
  QTest::addColumn<QSize>("size");
  // 358.4 x 280 x 200 mm.
  QTest::newRow("axial") << int(NamedPlane::axial) << 0.7 << QSize(512, 400);
  QTest::newRow("coronal") << int(NamedPlane::coronal) << 0.7 << QSize(512, 286);
  QTest::newRow("sagittal") << int(NamedPlane::sagittal) << 0.7 << QSize(400, 286);
  QTest::newRow("larger pixels") << int(NamedPlane::axial) << 100. << QSize(4, 3);
  QTest::newRow("one pixel at least") << int(NamedPlane::axial) << 1e9 << QSize(1, 1);
}

void TestPlane::theSmallestSizeCoversTheBox() {
  QFETCH(int, name);
  QFETCH(double, mmPerPixel);
  QFETCH(QSize, size);
  const VoxelGeometry g = axialScan();
  SlicePlane plane = namedPlane(g, NamedPlane(name));
  plane.mmPerPixel = mmPerPixel;
  const glm::ivec2 covers = sizeToCover(g, plane);
  QCOMPARE(QSize(covers.x, covers.y), size);
  if (mmPerPixel == 0.7) QCOMPARE(QSize(plane.size.x, plane.size.y), size);
}

void TestPlane::pixelsAndPositionsGoBackAndForth() {
  SlicePlane plane = planeAlong(axialScan(), oblique, glm::normalize(glm::cross(oblique, {1, 0, 0})));
  plane.size = {31, 20};
  QVERIFY(near(plane.patientFromPixel({15.5, 10}), plane.centre));
  QVERIFY(near(plane.patientFromPixel({16.5, 10}), plane.centre + 0.7 * plane.right));
  QVERIFY(near(plane.patientFromPixel({15.5, 12}), plane.centre + 1.4 * plane.down));
  const glm::dvec3 beside = plane.patientFromPixel({3.25, 17.5}) + 12.0 * plane.normal();
  QVERIFY(glm::length(plane.pixelFromPatient(beside) - glm::dvec2(3.25, 17.5)) < 1e-9);
}

void TestPlane::aVoxelAlongADirection_data() {
  QTest::addColumn<glm::dvec3>("normal");
  QTest::addColumn<double>("mm");
  QTest::newRow("pixels") << glm::dvec3(0, -1, 0) << 0.7;
  QTest::newRow("slices") << glm::dvec3(0, 0, 1) << 2.0;
  // 1 / |(1/3/0.7, 2/3/0.7, 2/3/2)|
  QTest::newRow("oblique") << oblique << 1 / std::sqrt(5 / (9 * 0.49) + 1. / 9);
}

void TestPlane::aVoxelAlongADirection() {
  QFETCH(glm::dvec3, normal);
  QFETCH(double, mm);
  QVERIFY(std::abs(voxelAlong(axialScan(), normal) - mm) < 1e-12);
}

void TestPlane::samplesOfSlabsAndPixels_data() {
  QTest::addColumn<double>("slabMm");
  QTest::addColumn<double>("mmPerPixel");
  QTest::addColumn<bool>("average");
  QTest::addColumn<qint64>("deep");
  QTest::addColumn<qint64>("perPixel");
  // Axial slices are 2 mm apart, with one sample a mm. The smallest voxel edge is 0.7 mm.
  QTest::newRow("no slab") << 0. << 0.7 << true << qint64(1) << qint64(1);
  QTest::newRow("thin slab") << 0.1 << 0.7 << true << qint64(1) << qint64(1);
  QTest::newRow("a slice") << 2. << 1.4 << true << qint64(2) << qint64(2);
  QTest::newRow("a little more") << 2.1 << 1.5 << true << qint64(3) << qint64(3);
  QTest::newRow("no average") << 20. << 7. << false << qint64(20) << qint64(1);
}

void TestPlane::samplesOfSlabsAndPixels() {
  QFETCH(double, slabMm);
  QFETCH(double, mmPerPixel);
  QFETCH(bool, average);
  SlicePlane plane = namedPlane(axialScan(), NamedPlane::axial);
  plane.slabMm = slabMm, plane.mmPerPixel = mmPerPixel, plane.average = average;
  QTEST(qint64(slabSamples(plane, axialScan())), "deep");
  QTEST(qint64(subSamples(plane, axialScan())), "perPixel");
}

void TestPlane::aStepOfTheWheel_data() {
  QTest::addColumn<glm::dvec3>("normal");
  QTest::addColumn<double>("mm");
  QTest::newRow("axial") << glm::dvec3(0, 0, 1) << 2.0;
  QTest::newRow("coronal") << glm::dvec3(0, 1, 0) << 0.7;
  QTest::newRow("tilted by 60 degrees against the slices, by 30 against the rows")
      << glm::dvec3(0, std::sqrt(0.75), 0.5) << 0.7 * std::sqrt(0.75);
  QTest::newRow("tilted by 30 degrees") << glm::dvec3(0, 0.5, -std::sqrt(0.75)) << 2 * std::sqrt(0.75);
}

void TestPlane::aStepOfTheWheel() {
  QFETCH(glm::dvec3, normal);
  QFETCH(double, mm);
  QVERIFY(std::abs(wheelStep(axialScan(), normal) - mm) < 1e-12);
}

void TestPlane::onSliceOnlyWhereParallel() {
  const VoxelGeometry g = axialScan();
  const SlicePlane axial = namedPlane(g, NamedPlane::axial);
  QVERIFY(near(onSlice(axial, g, 7)->centre, {axial.centre.x, axial.centre.y, 30 + 14}));
  QVERIFY(!onSlice(namedPlane(g, NamedPlane::coronal), g, 7));
  const auto tilted = [&](double by) { return planeAlong(g, {1, 0, 0}, {0, std::cos(by), std::sin(by)}); };
  QVERIFY(onSlice(tilted(0.9e-3), g, 7).has_value());
  QVERIFY(!onSlice(tilted(1.1e-3), g, 7).has_value());
}

VOLUMEN_TEST(TestPlane);
#include "tst_plane.moc"
