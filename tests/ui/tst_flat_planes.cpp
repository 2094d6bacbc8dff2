// Guards what a flat view shows of a volume: planes on acquired slices, and a wheel that scrolls down the
// patient. Planes stay orthogonal however they are turned.
#include <cmath>

#include "tests/unit/suite.h"
#include "ui/workspace/flat_plane.h"

using namespace volumen;

namespace {

// Returns 20 x 30 x 41 voxels of 0.5, 0.7, 2 mm at some patient position.
VoxelGeometry slab() {
  VoxelGeometry geometry;
  geometry.size = {20, 30, 41};
  for (int a = 0; a < 3; ++a) geometry.patientFromVoxelStep[a] *= glm::dvec3(0.5, 0.7, 2)[a];
  geometry.origin = {-100, 20, 300};
  return geometry;
}

}  // namespace

class TestFlatPlanes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void planesLieOnAcquiredSlices();
  void theWheelGoesDownThePatient_data();
  void theWheelGoesDownThePatient();
  void turningKeepsPlanesOrthogonalAndTheirPictures();
  void planesTurnToTheAcquiredSlices_data();
  void planesTurnToTheAcquiredSlices();
  void referenceLinesLieWhereThePlanesCut();
};

void TestFlatPlanes::planesLieOnAcquiredSlices() {
  const VoxelGeometry geometry = slab();
  const Crosshair cursor = firstCrosshair(geometry);
  const glm::dvec3 pVoxel = geometry.voxelFromPatient(cursor.at);
  for (int a = 0; a < 3; ++a) QVERIFY(std::abs(pVoxel[a] - std::round(pVoxel[a])) < 1e-9);
  ViewState view;
  view.kind = ViewKind::axial;
  const SlicePlane plane = flatPlane(view, {}, geometry, cursor, {300, 200});
  QCOMPARE(plane.size, glm::ivec2(300, 200));
  QVERIFY(std::abs(plane.centre.z - cursor.at.z) < 1e-9);
  // 10 x 21 mm, with the height in 200 pixels.
  QVERIFY(std::abs(plane.mmPerPixel - 21.0 / 200) < 1e-9);
}

void TestFlatPlanes::theWheelGoesDownThePatient_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<glm::dvec3>("step");
  QTest::addColumn<int>("count");
  QTest::newRow("axial: caudal") << int(ViewKind::axial) << glm::dvec3(0, 0, -2) << 41;
  QTest::newRow("coronal: posterior") << int(ViewKind::coronal) << glm::dvec3(0, 0.7, 0) << 30;
  QTest::newRow("sagittal: left") << int(ViewKind::sagittal) << glm::dvec3(0.5, 0, 0) << 20;
}

void TestFlatPlanes::theWheelGoesDownThePatient() {
  QFETCH(int, kind);
  QFETCH(glm::dvec3, step);
  QFETCH(int, count);
  const VoxelGeometry geometry = slab();
  const Crosshair cursor = firstCrosshair(geometry);
  const auto near = [](glm::dvec3 a, glm::dvec3 b) { return glm::length(a - b) < 1e-9; };
  QVERIFY(near(scrolled(geometry, ViewKind(kind), cursor, 3), cursor.at + 3.0 * step));
  const StackPlace place = stackPlace(geometry, ViewKind(kind), cursor);
  QCOMPARE(place.count, count);
  const Crosshair end{scrolled(geometry, ViewKind(kind), cursor, 1000)};
  QCOMPARE(stackPlace(geometry, ViewKind(kind), end).index, count - 1);
  QVERIFY2(near(end.at, cursor.at + double(count - 1 - place.index) * step), "it stops at the last slice");
}

void TestFlatPlanes::turningKeepsPlanesOrthogonalAndTheirPictures() {
  const VoxelGeometry geometry = slab();
  const Crosshair first = firstCrosshair(geometry);
  const Crosshair turned = turnedIn(turnedIn(first, ViewKind::axial, 0.4), ViewKind::sagittal, -0.7);
  QVERIFY2(turnedIn(first, ViewKind::axial, 0.4).axial == first.axial, "the view under the hand stays");
  QVERIFY(turned.turned() && !first.turned());
  const glm::dvec3 a = turned.axial.normal(), c = turned.coronal.normal(), s = turned.sagittal.normal();
  for (const auto& [x, y] : {std::pair(a, c), std::pair(c, s), std::pair(s, a)})
    QVERIFY(std::abs(glm::dot(x, y)) < 1e-12);
  for (const ViewKind kind : {ViewKind::axial, ViewKind::coronal, ViewKind::sagittal}) {
    ViewState view;
    view.kind = kind;
    const SlicePlane before = flatPlane(view, {}, geometry, first, {300, 200});
    const SlicePlane after = flatPlane(view, {}, geometry, turned, {300, 200});
    QCOMPARE(after.mmPerPixel, before.mmPerPixel);
    QVERIFY(std::abs(glm::dot(after.centre - turned.at, after.normal())) < 1e-9);
  }
}

void TestFlatPlanes::planesTurnToTheAcquiredSlices_data() {
  QTest::addColumn<glm::dvec3>("i");
  QTest::addColumn<glm::dvec3>("j");
  QTest::addColumn<int>("kind");
  const double c = std::cos(0.3), s = std::sin(0.3);
  QTest::newRow("axial, tilted") << glm::dvec3(1, 0, 0) << glm::dvec3(0, c, s) << int(ViewKind::axial);
  QTest::newRow("axial, feet first") << glm::dvec3(-1, 0, 0) << glm::dvec3(0, c, s) << int(ViewKind::axial);
  QTest::newRow("coronal") << glm::dvec3(c, s, 0) << glm::dvec3(0, 0, -1) << int(ViewKind::coronal);
  QTest::newRow("sagittal") << glm::dvec3(s, c, 0) << glm::dvec3(0, 0, -1) << int(ViewKind::sagittal);
}

void TestFlatPlanes::planesTurnToTheAcquiredSlices() {
  QFETCH(glm::dvec3, i);
  QFETCH(glm::dvec3, j);
  QFETCH(int, kind);
  VoxelGeometry geometry = slab();
  geometry.patientFromVoxelStep = glm::dmat3(0.5 * i, 0.7 * j, 2.0 * glm::cross(i, j));
  const Crosshair along = alongSlices({1, 2, 3}, geometry);
  QCOMPARE(along.at, glm::dvec3(1, 2, 3));
  QVERIFY(std::abs(std::abs(glm::dot(along.plane(ViewKind(kind)).normal(), glm::cross(i, j))) - 1) < 1e-12);
  const Crosshair unturned{along.at};
  for (const ViewKind each : {ViewKind::axial, ViewKind::coronal, ViewKind::sagittal})
    QVERIFY2(glm::dot(along.plane(each).normal(), unturned.plane(each).normal()) > 0.9,
             "by the smallest turn");
}

void TestFlatPlanes::referenceLinesLieWhereThePlanesCut() {
  const VoxelGeometry geometry = slab();
  Crosshair cursor = firstCrosshair(geometry);
  ViewState axial, sagittal;
  axial.kind = ViewKind::axial;
  sagittal.kind = ViewKind::sagittal;
  const SlicePlane a = flatPlane(axial, {}, geometry, cursor, {300, 200});
  cursor.at.x += 2;
  const SlicePlane s = flatPlane(sagittal, {}, geometry, cursor, {300, 200});
  const auto line = referenceLine(a, s);
  QVERIFY(line);
  const double x = a.pixelFromPatient(cursor.at).x;
  QVERIFY(std::abs(line->from.x - x) < 1e-6 && std::abs(line->to.x - x) < 1e-6);
  QVERIFY(std::abs(line->from.y - line->to.y) > 200);
  QVERIFY2(!referenceLine(a, a), "parallel");
}

VOLUMEN_TEST(TestFlatPlanes);
#include "tst_flat_planes.moc"
