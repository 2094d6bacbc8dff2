// Guards surface.h and farthest_points.h: surfaces stay closed when triangles are reduced, and distances are
// exact, compared with testing all triangles. Random cases: VOLUMEN_RANDOM_CASES=N, VOLUMEN_RANDOM_SEED=S.
#include <algorithm>

#include "tests/fixtures/seeds.h"
#include "tests/unit/segment/shape_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/farthest_points.h"
#include "viewer/segment/occupancy.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestSurfaceDistance : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void fewerTrianglesStayClosed_data();
  void fewerTrianglesStayClosed();
  void flatFacesAreTwoTriangles();
  void deviationIsExact();
  void cancelledEndsEarly();
  void farthestPointsAreTheFarthest();
};

namespace {

QByteArray toldBySeed(std::uint64_t seed, const std::string& what) {
  return QByteArray::fromStdString("seed " + std::to_string(seed) + ": " + what);
}

}  // namespace

void TestSurfaceDistance::fewerTrianglesStayClosed_data() {
  QTest::addColumn<double>("tolerance");
  for (const double tolerance : {0.0, 0.05, 0.3, 2.0, 100.0}) QTest::addRow("%g mm", tolerance) << tolerance;
}

// Covers a ball and random masks with handles, holes and components reduced to four points.
void TestSurfaceDistance::fewerTrianglesStayClosed() {
  QFETCH(double, tolerance);
  const Seeds seeds = seedsOf(150, 1500);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    const Surface all = *surfaceOf(anyField(std::uint64_t(seed)));
    const Surface fewer = reduced(all, tolerance);
    const std::string wrong = notClosed(fewer);
    QVERIFY2(wrong.empty() || wrong == "two points are at one place", toldBySeed(std::uint64_t(seed), wrong));
    QVERIFY(fewer.triangles.size() <= all.triangles.size());
    // Handles and components remain, as the Euler characteristic from triangles and points shows.
    QCOMPARE(2 * int(fewer.points.size()) - int(fewer.triangles.size()),
             2 * int(all.points.size()) - int(all.triangles.size()));
  }
  const Surface ball = ballSurface(15, grids[2].patientFromVoxelStep);
  const Surface fewer = reduced(ball, tolerance);
  QCOMPARE(notClosed(fewer), std::string());
  if (tolerance > 0 && tolerance < 1) {
    QVERIFY(fewer.triangles.size() < ball.triangles.size() * (tolerance < 0.1 ? 0.9 : 0.5));
    // Points are within the tolerance of the planes. If planes meet at an angle, points may be slightly
    // farther from the triangles.
    QVERIFY2(deviation(fewer, ball).largest < 2 * tolerance,
             qPrintable(QString::number(deviation(fewer, ball).largest)));
    QVERIFY(std::abs(volumeOf(fewer) / volumeOf(ball) - 1) < 0.02);
  }
}

// The unsmoothed block has six faces with bevelled edges, which need only a few triangles each.
void TestSurfaceDistance::flatFacesAreTwoTriangles() {
  BitMask mask({.size = {12, 9, 7}});
  for (int k = 0; k < 7; ++k)
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 12; ++i) mask.set({i, j, k});
  const Surface all = *surfaceOf(occupancyOf(mask, 0));
  const Surface fewer = reduced(all, 1e-4);
  QVERIFY(all.triangles.size() > 1000);
  // The flat faces have 24 corners, which gives 2 * 24 - 4 triangles.
  QVERIFY2(fewer.triangles.size() <= 60, qPrintable(QString::number(fewer.triangles.size())));
  QVERIFY(std::abs(volumeOf(fewer) / volumeOf(all) - 1) < 1e-5);
  QVERIFY(deviation(all, fewer).largest < 2e-4);
}

namespace {

// Returns the distance from a point to a triangle, independently of the program. It is to the foot on the
// plane if that is inside, else to the nearest edge.
double distanceToTriangle(dvec3 p, const std::array<dvec3, 3>& t) {
  const dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  double nearest = 1e300;
  bool inside = glm::length(normal) > 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const dvec3 a = t[n], along = t[(n + 1) % 3] - a;
    const double part = glm::dot(along, along) > 0
                            ? std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0)
                            : 0;
    nearest = std::min(nearest, glm::distance(p, a + part * along));
    inside = inside && glm::dot(glm::cross(along, p - a), normal) >= 0;
  }
  return inside ? std::abs(glm::dot(p - t[0], glm::normalize(normal))) : nearest;
}

std::array<dvec3, 3> cornersOf(const Surface& surface, const std::array<std::uint32_t, 3>& t) {
  return {dvec3(surface.points[t[0]]), dvec3(surface.points[t[1]]), dvec3(surface.points[t[2]])};
}

}  // namespace

void TestSurfaceDistance::deviationIsExact() {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Surface a = *surfaceOf(anyField(seed)), b = *surfaceOf(anyField(seed + 1000));
    if (a.triangles.empty() || b.triangles.empty()) continue;
    if (a.triangles.size() * b.triangles.size() > 400000) continue;
    const auto toB = [&](dvec3 p) {
      double nearest = 1e300;
      for (const auto& t : b.triangles) nearest = std::min(nearest, distanceToTriangle(p, cornersOf(b, t)));
      return nearest;
    };
    double largest = 0, sum = 0, area = 0;
    for (const auto& t : a.triangles) {
      const auto c = cornersOf(a, t);
      const double of = glm::length(glm::cross(c[1] - c[0], c[2] - c[0])) / 2;
      const double middle = toB((c[0] + c[1] + c[2]) / 3.0);
      sum += of * middle, area += of;
      largest = std::max(largest, middle);
    }
    for (const glm::vec3& p : a.points) largest = std::max(largest, toB(dvec3(p)));
    const Deviation found = deviation(a, b);
    QVERIFY2(std::abs(found.largest - largest) < 1e-9 * (1 + largest),
             toldBySeed(seed, std::to_string(found.largest)));
    QVERIFY2(std::abs(found.mean - sum / area) < 1e-9 * (1 + largest),
             toldBySeed(seed, std::to_string(found.mean)));
  }
}

void TestSurfaceDistance::farthestPointsAreTheFarthest() {
  std::vector<Surface> surfaces{ballSurface(12, grids[3].patientFromVoxelStep)};
  for (std::uint64_t seed = 1; seed <= 60; ++seed) surfaces.push_back(*surfaceOf(anyField(seed)));
  for (const Surface& surface : surfaces) {
    if (surface.points.empty()) continue;
    double farthest = 0;
    for (const glm::vec3& p : surface.points)
      for (const glm::vec3& q : surface.points)
        farthest = std::max(farthest, glm::distance(dvec3(p), dvec3(q)));
    const auto ends = farthestPoints(surface);
    QCOMPARE(glm::distance(dvec3(ends[0]), dvec3(ends[1])), farthest);
  }
}

void TestSurfaceDistance::cancelledEndsEarly() {
  const Surface ball = ballSurface(15, glm::dmat3(1)), smaller = ballSurface(12, glm::dmat3(1));
  QVERIFY(deviation(ball, smaller).largest > 2);
  const CancelToken cancel;
  cancel.cancel();
  QCOMPARE(deviation(ball, smaller, cancel).largest, 0.0);
}

VOLUMEN_TEST(TestSurfaceDistance);
#include "tst_surface_distance.moc"
