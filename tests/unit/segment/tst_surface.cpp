// Guards surface.h: surfaces of segments are closed on every grid, lie where the field is 1/2, and stay
// closed when triangles are reduced. Distances between them are exact. Random cases: VOLUMEN_RANDOM_CASES=N,
// VOLUMEN_RANDOM_SEED=S.
#include <tbb/global_control.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/real_volume.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/segment/drawn_volume.h"
#include "tests/unit/segment/shape_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/farthest_points.h"
#include "viewer/segment/occupancy.h"
#include "viewer/segment/range.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestSurface : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void isClosed_data();
  void isClosed();
  void liesNearTheFieldsOwnVolume();
  void closedForms_data();
  void closedForms();
  void phantomOfIbsi();
  void shellsAreTold();
  void nothingHasNoTriangles();
  void crossingsKeepApart();
  void anyNumberOfThreads();
  void whatIsCancelled();
  void bonesOfARealCt();
};

namespace {

int pointsInside(const OccupancyField& field) {
  return int(std::ranges::count_if(field.values, [](float v) { return v >= 0.5f; }));
}

QByteArray seedText(std::uint64_t seed, const std::string& what) {
  return QByteArray::fromStdString("seed " + std::to_string(seed) + ": " + what);
}

bool sameBytes(const Surface& a, const Surface& b) {
  return a.points == b.points && a.triangles == b.triangles;
}

}  // namespace

void TestSurface::isClosed_data() {
  QTest::addColumn<int>("first");
  QTest::addColumn<int>("behindLast");
  const Seeds seeds = seedsOf(2000, 20000);
  constexpr int together = 1000;
  for (int first = seeds.first; first < seeds.behindLast(); first += together)
    QTest::addRow("seeds from %d", first) << first << std::min(first + together, seeds.behindLast());
}

void TestSurface::isClosed() {
  QFETCH(int, first);
  QFETCH(int, behindLast);
  for (int seed = first; seed < behindLast; ++seed) {
    const OccupancyField field = anyField(std::uint64_t(seed));
    for (const Result<Surface>& surface : {surfaceOf(field), volumePreservingSurface(field)}) {
      QVERIFY(surface.ok());
      const std::string wrong = notClosed(*surface);
      QVERIFY2(wrong.empty(), seedText(std::uint64_t(seed), wrong));
      QCOMPARE(surface->triangles.empty(), pointsInside(field) == 0);
      if (!surface->triangles.empty())
        QVERIFY2(volumeOf(*surface) > 0, seedText(std::uint64_t(seed), "it is inside out"));
    }
  }
}

// Noise is the worst case. If inside corners are opposite on a face, the surface separates them, whereas the
// field may join them. The surface thus encloses less, by at most a tenth over all cells.
void TestSurface::liesNearTheFieldsOwnVolume() {
  double all = 0, twin = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const OccupancyField field = anyField(seed);
    const double voxel = field.geometry.voxelVolume();
    const double volume = volumeOf(*surfaceOf(field)) / voxel, inside = drawnVolume(field) / voxel;
    const auto cells = double(field.values.size());
    QVERIFY2(std::abs(volume - inside) < 1 + 0.05 * cells,
             seedText(seed, std::to_string(volume) + ", not " + std::to_string(inside)));
    all += volume, twin += inside;
    // Neither the 10 x 10 x 10 points in a cell nor the 5 x 5 lines are exact.
    const double lines = volumeOf(field) / voxel;
    QVERIFY2(std::abs(lines - inside) < 0.01 + 0.003 * cells,
             seedText(seed, std::to_string(lines) + ", not " + std::to_string(inside)));
  }
  QVERIFY2(all / twin > 0.9 && all / twin < 1, qPrintable(QString::number(all / twin)));
}

void TestSurface::closedForms_data() {
  QTest::addColumn<glm::dmat3>("step");
  for (const Grid& g : grids) QTest::newRow(g.name) << g.patientFromVoxelStep;
}

// Flat triangles of h mm inside a ball of r mm lack about h^2 / 8 r of its radius. For h = 2.5 mm and r = 15
// mm that is 0.05 mm, 1 % of the volume.
void TestSurface::closedForms() {
  QFETCH(glm::dmat3, step);
  const double r = 15;
  const Surface surface = ballSurface(r, step, {1, -2, 0.5});
  QCOMPARE(notClosed(surface), std::string());
  const double volume = 4.0 / 3 * std::numbers::pi * r * r * r, area = 4 * std::numbers::pi * r * r;
  QVERIFY2(std::abs(volumeOf(surface) / volume - 1) < 0.01,
           qPrintable(QString::number(volumeOf(surface) / volume)));
  QVERIFY2(std::abs(areaOf(surface) / area - 1) < 0.01, qPrintable(QString::number(areaOf(surface) / area)));
  for (const glm::vec3& p : surface.points)
    QVERIFY(std::abs(glm::distance(dvec3(p), dvec3(1, -2, 0.5)) - r) < 0.15);
}

// Reference values of the unsmoothed mask are 556 mm^3, 388 mm^2 and 13.1 mm (IBSI 11.0, volume, surface
// area, maximum 3D diameter).
void TestSurface::phantomOfIbsi() {
  const BitMask mask = ibsiPhantom();
  QCOMPARE(mask.count(), std::int64_t(74));
  const Surface surface = *surfaceOf(occupancyOf(mask, 0));
  QCOMPARE(notClosed(surface), std::string());
  QVERIFY2(std::abs(volumeOf(surface) - 556.33) < 0.7, qPrintable(QString::number(volumeOf(surface))));
  QVERIFY2(std::abs(areaOf(surface) - 388.07) < 0.7, qPrintable(QString::number(areaOf(surface))));
  const auto ends = farthestPoints(surface);
  QVERIFY(std::abs(double(glm::distance(ends[0], ends[1])) - 13.115) < 1e-3);
}

// A ball of 6 mm has a cavity of 3 mm. A ball of 4 mm touches it at most by corners.
void TestSurface::shellsAreTold() {
  const Shape3 outer = ball(6, {-5, 0, 0}), cavity = ball(3, {-5, 0, 0}), other = ball(4, {6, 0, 0});
  const BitMask mask = maskOfShape(gridAbout(glm::dmat3(0.5), 14),
                                   [&](dvec3 p) { return (outer(p) && !cavity(p)) || other(p); });
  const Surface surface = *volumePreservingSurface(occupancyOf(mask, surfaceSigma));
  const std::vector<double> volumes = shellVolumes(surface);
  QCOMPARE(volumes.size(), std::size_t(3));
  const auto isNear = [](double volume, double radius) {
    return std::abs(std::abs(volume) / (4.0 / 3 * std::numbers::pi * radius * radius * radius) - 1) < 0.1;
  };
  QVERIFY(isNear(volumes[0], 6) && isNear(volumes[1], 4) && isNear(volumes[2], 3) && volumes[2] < 0);
  QVERIFY(std::abs(volumes[0] + volumes[1] + volumes[2] - volumeOf(surface)) < 1e-6 * volumes[0]);
  QVERIFY(shellVolumes(Surface()).empty());
}

void TestSurface::nothingHasNoTriangles() {
  const BitMask none({.size = {70, 3, 4}});
  const Result<Surface> surface = surfaceOf(occupancyOf(none, surfaceSigma));
  QVERIFY(surface.ok());
  QVERIFY(surface->points.empty() && surface->triangles.empty());
  QCOMPARE(volumeOf(*surface), 0.0);
  QCOMPARE(areaOf(*surface), 0.0);
  QVERIFY(reduced(*surface, 1).triangles.empty());
  QCOMPARE(deviation(*surface, *surface).largest, 0.0);
}

// The value is exactly 1/2 or slightly above. Six crossings about one point must stay six points.
void TestSurface::crossingsKeepApart() {
  for (const float value : {0.5f, 0.5f + 1e-7f, 0.5f + 1e-4f}) {
    OccupancyField field{
        {.size = {1, 1, 1}, .origin = {812.3, -455.1, 1200.7}}, {glm::ivec3(-1), glm::ivec3(1)}, {}};
    field.values.assign(27, 0);
    field.values[13] = value;
    const Surface surface = *surfaceOf(field);
    QCOMPARE(surface.points.size(), std::size_t(6));
    QCOMPARE(notClosed(surface), std::string());
    for (const glm::vec3& p : surface.points)
      QVERIFY(std::abs(glm::distance(dvec3(p), field.geometry.origin) - 0.02) < 1e-3);
  }
}

void TestSurface::anyNumberOfThreads() {
  const OccupancyField field = occupancyOf(
      maskOfShape(gridAbout(grids[2].patientFromVoxelStep, 21), cylinder(9, 35, {1, 2, 3})), surfaceSigma);
  const Surface all = *surfaceOf(field);
  const Surface other = ballSurface(9, grids[1].patientFromVoxelStep);
  const Surface preserving = *volumePreservingSurface(field);
  const double area = areaOf(all), volume = volumeOf(all), drawn = volumeOf(field);
  const Deviation apart = deviation(all, other);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  QVERIFY(sameBytes(*surfaceOf(field), all));
  QVERIFY(sameBytes(*volumePreservingSurface(field), preserving));
  QCOMPARE(volumeOf(field), drawn);
  QCOMPARE(areaOf(all), area);
  QCOMPARE(volumeOf(all), volume);
  QCOMPARE(deviation(all, other).largest, apart.largest);
  QCOMPARE(deviation(all, other).mean, apart.mean);
}

void TestSurface::whatIsCancelled() {
  CancelToken cancel;
  cancel.cancel();
  const OccupancyField field = anyField(1);
  QVERIFY(!surfaceOf(field, cancel).ok());
  QVERIFY(!volumePreservingSurface(field, cancel).ok());
  const Surface ball = ballSurface(10, glm::dmat3(1));
  QCOMPARE(notClosed(reduced(ball, 1, cancel)), std::string());
}

// The surface of real bones must be closed and enclose nearly the volume of their voxels.
void TestSurface::bonesOfARealCt() {
  const VolumePtr ct = realVolume("ct-chest-lidc0314-138");
  NEED_VOLUME(ct);
  BitMask bones = voxelsInRange(*ct, {226, 3000});
  for (int k = 60; k < bones.size().z; ++k)  // only some slices, as testing each edge is slow
    for (int j = 0; j < bones.size().y; ++j) std::ranges::fill(bones.row(j, k), 0);
  for (int k = 0; k < 45; ++k)
    for (int j = 0; j < bones.size().y; ++j) std::ranges::fill(bones.row(j, k), 0);
  const Surface surface = *surfaceOf(occupancyOf(bones, surfaceSigma));
  QVERIFY(surface.triangles.size() > 100000);
  QCOMPARE(notClosed(surface), std::string());
  const double ratio = volumeOf(surface) / (double(bones.count()) * ct->geometry().voxelVolume());
  QVERIFY2(std::abs(ratio - 1) < 0.1, qPrintable(QString::number(ratio)));
}

VOLUMEN_TEST(TestSurface);
#include "tst_surface.moc"
