// Guards slices.md 4: the voxels of a region, and their statistics.
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/measure/outline.h"
#include "viewer/measure/region.h"
#include "viewer/slice/plane.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec2;
using glm::dvec3;

class TestRegion : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void discOfKnownMean_data();
  void discOfKnownMean();
  void statisticsByHand();
  void equalValuesHaveNoDeviation();
  void isTheDefinition_data();
  void isTheDefinition();
  void stackedPlanesHoldEveryVoxelOnce_data();
  void stackedPlanesHoldEveryVoxelOnce();
  void shapesThatAbutShareNone();
  void planeHalfwayBetweenSlicesHoldsOneOfThem();
  void paddingIsLeftOut();
  void noVoxelInside_data();
  void noVoxelInside();
};

namespace {

Shape regionOn(const ShapePlane& plane, ShapeKind kind, const std::vector<dvec2>& corners) {
  Shape shape;
  shape.kind = kind;
  shape.plane = plane;
  for (dvec2 c : corners) shape.points.push_back(plane.centre + c.x * plane.right + c.y * plane.down);
  return shape;
}

/// Returns a volume in which every voxel has its own value.
VolumePtr numbered(glm::ivec3 size, glm::dmat3 step) {
  return volumeOf<float>(size, step, [&](dvec3 p) { return (p.z * size.y + p.y) * size.x + p.x; });
}

/// Returns a plane with no voxel centre near its limits.
ShapePlane somePlane(Chance& chance) {
  ShapePlane plane;
  plane.centre = 1.5 * chance.vector();
  plane.right = glm::normalize(chance.vector() + dvec3(1.2, 0, 0));
  plane.down = glm::normalize(glm::cross(chance.vector() + dvec3(0, 0, 1.2), plane.right));
  return plane;
}

}  // namespace

void TestRegion::discOfKnownMean_data() {
  QTest::addColumn<double>("mmPerVoxel");
  QTest::addColumn<double>("inside");
  QTest::newRow("1 mm") << 1.0 << 70.0;
  QTest::newRow("0.3 mm, negative") << 0.3 << -55.5;
}

// A disc of one value lies in another value. A slightly smaller ellipse holds only the disc. Its number of
// voxels equals its area up to voxels on its edge.
void TestRegion::discOfKnownMean() {
  QFETCH(double, mmPerVoxel);
  QFETCH(double, inside);
  const dvec3 centre(31.5, 31.5, 1);
  const VolumePtr volume = volumeOf<float>({64, 64, 3}, glm::dmat3(mmPerVoxel), [&](dvec3 p) {
    return glm::length(p - centre) <= 20 ? inside : 1000;
  });
  const double r = 19 * mmPerVoxel;
  const Shape disc = regionOn({}, ShapeKind::ellipse, {{-r, -r}, {r, r}});
  const auto s = regionValues(disc, *volume);
  QVERIFY(s.has_value());
  QCOMPARE(s->mean, inside);
  QCOMPARE(s->sd, 0.0);
  QCOMPARE(s->min, inside);
  QCOMPARE(s->max, inside);
  const double area = areaOf(outlineOf(disc)) / (mmPerVoxel * mmPerVoxel);
  QVERIFY(std::abs(double(s->n) - area) < 0.01 * area);
}

void TestRegion::statisticsByHand() {
  const double values[] = {2, 4, 4, 4, 5, 5, 7, 9};  // mean 5, standard deviation 2
  const VolumePtr volume =
      volumeOf<std::int16_t>({8, 1, 1}, glm::dmat3(1), [&](dvec3 p) { return values[int(p.x)]; });
  const auto s = regionValues(regionOn({}, ShapeKind::rectangle, {{-4, -1}, {4, 1}}), *volume);
  QCOMPARE(s->n, std::int64_t(8));
  QCOMPARE(s->mean, 5.0);
  QCOMPARE(s->sd, 2.0);
  QCOMPARE(s->min, 2.0);
  QCOMPARE(s->max, 9.0);
}

void TestRegion::equalValuesHaveNoDeviation() {
  const VolumePtr volume = volumeOf<float>({30, 30, 1}, glm::dmat3(1), [](dvec3) { return 0.1; });
  const auto s = regionValues(regionOn({}, ShapeKind::rectangle, {{-20, -20}, {20, 20}}), *volume);
  QCOMPARE(s->n, std::int64_t(900));
  QCOMPARE(s->mean, double(0.1f));
  QCOMPARE(s->sd, 0.0);
}

void TestRegion::isTheDefinition_data() {
  QTest::addColumn<glm::dmat3>("step");
  QTest::addColumn<quint64>("seed");
  for (const Grid& g : grids)
    for (quint64 seed = 1; seed <= 8; ++seed)
      QTest::addRow("%s, seed %llu", g.name, seed) << g.patientFromVoxelStep << seed;
}

// Tests each voxel separately by the definition in slices.md 4.
void TestRegion::isTheDefinition() {
  QFETCH(glm::dmat3, step);
  QFETCH(quint64, seed);
  Chance chance(seed);
  const VolumePtr volume = numbered({12, 11, 9}, step);
  const ShapePlane plane = somePlane(chance);
  const auto kind = ShapeKind(int(ShapeKind::ellipse) + chance.below(3));
  std::vector<dvec2> corners;
  for (int n = 0; n < (kind == ShapeKind::freehand ? 7 : 2); ++n)
    corners.emplace_back(chance.between(-6, 6), chance.between(-6, 6));
  const Shape region = regionOn(plane, kind, corners);
  const double half = wheelStep(volume->geometry(), plane.normal()) / 2;
  std::int64_t n = 0;
  double sum = 0;
  for (std::int64_t v = 0; v < volume->geometry().voxelCount(); ++v) {
    const glm::ivec3 x(v % 12, v / 12 % 11, v / 132);
    const dvec3 p = volume->geometry().patientFromVoxel(dvec3(x));
    if (std::abs(glm::dot(p - plane.centre, plane.normal())) >= half) continue;
    if (!contains(outlineOf(region), onPlane(plane, p))) continue;
    ++n;
    sum += double(v);
  }
  const auto s = regionValues(region, *volume);
  QCOMPARE(s ? s->n : 0, n);
  if (s) QVERIFY(std::abs(s->mean - sum / double(n)) < 1e-9);
}

void TestRegion::stackedPlanesHoldEveryVoxelOnce_data() {
  QTest::addColumn<glm::dmat3>("step");
  QTest::addColumn<bool>("oblique");
  for (const Grid& g : grids)
    for (bool oblique : {false, true})
      QTest::addRow("%s, %s", g.name, oblique ? "oblique" : "along an axis")
          << g.patientFromVoxelStep << oblique;
}

void TestRegion::stackedPlanesHoldEveryVoxelOnce() {
  QFETCH(glm::dmat3, step);
  QFETCH(bool, oblique);
  Chance chance(5);
  const VolumePtr volume = numbered({7, 6, 8}, step);
  ShapePlane plane;
  if (oblique) plane = somePlane(chance);
  const double mm = wheelStep(volume->geometry(), plane.normal());
  const dvec3 middle = plane.centre;
  std::int64_t voxels = 0;
  double sum = 0;
  for (int n = -60; n <= 60; ++n) {
    plane.centre = middle + n * mm * plane.normal();
    const auto s = regionValues(regionOn(plane, ShapeKind::rectangle, {{-99, -99}, {99, 99}}), *volume);
    if (!s) continue;
    voxels += s->n;
    sum += s->mean * double(s->n);
  }
  QCOMPARE(voxels, std::int64_t(336));
  QVERIFY(std::abs(sum - 336 * 335 / 2.0) < 1e-6);  // every number exactly once
}

void TestRegion::shapesThatAbutShareNone() {
  // Edges lie on voxel centres: -2, 0 and 2 mm with voxels at -4.5, -4 ... 4.5.
  const VolumePtr volume = numbered({19, 19, 1}, glm::dmat3(0.5));
  std::int64_t parts = 0;
  for (dvec2 corner : {dvec2(-2, -2), dvec2(0, -2), dvec2(-2, 0), dvec2(0, 0)}) {
    Shape part = regionOn({}, ShapeKind::rectangle, {corner, corner + 2.0});
    part.plane->centre = dvec3(0.3 * corner, 0);  // the same plane with another centre
    const auto s = regionValues(part, *volume);
    QCOMPARE(s->n, std::int64_t(16));
    parts += s->n;
  }
  const auto whole = regionValues(regionOn({}, ShapeKind::rectangle, {{-2, -2}, {2, 2}}), *volume);
  QCOMPARE(parts, whole->n);
  const auto left = regionValues(regionOn({}, ShapeKind::freehand, {{-2, -2}, {2, 2}, {-2, 2}}), *volume);
  const auto right = regionValues(regionOn({}, ShapeKind::freehand, {{-2, -2}, {2, -2}, {2, 2}}), *volume);
  QCOMPARE(left->n + right->n, whole->n);
}

// Rounding may choose either slice, but never both or neither.
void TestRegion::planeHalfwayBetweenSlicesHoldsOneOfThem() {
  for (double mm : {0.1, 0.3, 0.7, 1.1, 2.3, 3.3}) {
    const VolumePtr volume = numbered({4, 4, 6}, {mm, 0, 0, 0, mm, 0, 0, 0, mm});
    for (int k = 0; k < 5; ++k) {
      ShapePlane plane;
      plane.centre.z = volume->geometry().origin.z + (k + 0.5) * mm;
      const auto s = regionValues(regionOn(plane, ShapeKind::rectangle, {{-9, -9}, {9, 9}}), *volume);
      QCOMPARE(s->n, std::int64_t(16));
      QCOMPARE(s->min, 16.0 * k);
    }
  }
}

void TestRegion::paddingIsLeftOut() {
  VolumeParts parts;
  parts.geometry.size = {4, 1, 1};
  parts.values = std::vector<std::int16_t>{-2000, 10, 20, -1999};
  parts.attributes.padding = ValueRange{-2000, -1999};
  const VolumePtr volume = volumeFrom(parts);
  const auto s = regionValues(regionOn({}, ShapeKind::rectangle, {{-9, -9}, {9, 9}}), *volume);
  QCOMPARE(s->n, std::int64_t(2));
  QCOMPARE(s->mean, 15.0);
  parts.attributes.padding = ValueRange{-2000, 20};
  QVERIFY(!regionValues(regionOn({}, ShapeKind::rectangle, {{-9, -9}, {9, 9}}), *volumeFrom(parts)));
}

void TestRegion::noVoxelInside_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<std::vector<dvec2>>("corners");
  QTest::addColumn<double>("z");
  const auto row = [](const char* name, ShapeKind kind, std::vector<dvec2> corners, double z) {
    QTest::newRow(name) << int(kind) << corners << z;
  };
  row("between centres", ShapeKind::rectangle, {{0.1, 0.1}, {0.4, 0.4}}, 0.5);
  row("of no size", ShapeKind::ellipse, {{0.5, 0.5}, {0.5, 0.5}}, 0.5);
  row("on one line", ShapeKind::freehand, {{-2, -2}, {0, 0}, {2, 2}}, 0.5);
  row("beside the volume", ShapeKind::rectangle, {{50, 50}, {60, 60}}, 0.5);
  row("above the volume", ShapeKind::rectangle, {{-9, -9}, {9, 9}}, 40);
  row("just above the volume", ShapeKind::rectangle, {{-9, -9}, {9, 9}}, 2.51);
  row("far away", ShapeKind::freehand, {{-1e9, -1e9}, {-1e9, -9e8}, {-9e8, -9e8}}, 1e9);
}

void TestRegion::noVoxelInside() {
  QFETCH(int, kind);
  QFETCH(std::vector<dvec2>, corners);
  QFETCH(double, z);
  const VolumePtr volume = numbered({4, 4, 4}, glm::dmat3(1));
  ShapePlane plane;
  plane.centre.z = z;
  QVERIFY(!regionValues(regionOn(plane, ShapeKind(kind), corners), *volume));
}

VOLUMEN_TEST(TestRegion);
#include "tst_region.moc"
