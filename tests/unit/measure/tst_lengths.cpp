// Guards slices.md 4: lengths with their uncertainty, angles, and the Cobb angle.
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/unit/suite.h"
#include "viewer/measure/lengths.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestLengths : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void sumsItsSegments_data();
  void sumsItsSegments();
  void isOffByTheVoxelsAlongIt_data();
  void isOffByTheVoxelsAlongIt();
  void aSoftSurfaceAddsToBothEnds_data();
  void aSoftSurfaceAddsToBothEnds();
  void holdsOnEveryGrid_data();
  void holdsOnEveryGrid();
  void holdsForPolylinesOnEveryGrid_data();
  void holdsForPolylinesOnEveryGrid();
  void angles_data();
  void angles();
  void noAngleWithoutArms();
};

namespace {

VoxelGeometry grid(glm::dmat3 step) { return {.size = {10, 10, 10}, .patientFromVoxelStep = step}; }

bool near(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(1.0, std::abs(b)); }

// Adds a row for each grid of the fixtures and for twelve by chance.
void addGrids() {
  QTest::addColumn<glm::dmat3>("step");
  for (const Grid& g : grids) QTest::newRow(g.name) << g.patientFromVoxelStep;
  for (const Grid& g : thickGrids) QTest::newRow(g.name) << g.patientFromVoxelStep;
  for (int seed = 1; seed <= 12; ++seed) {
    Chance chance{std::uint64_t(seed)};
    const dvec3 x = glm::normalize(chance.vector()), y = glm::normalize(glm::cross(x, chance.vector()));
    glm::dmat3 step(x, y, glm::cross(x, y));
    for (int a = 0; a < 3; ++a) step[a] *= chance.power(-0.5, 0.8);
    if (chance.oneIn(2)) step[2] += chance.between(-0.6, 0.6) * step[0] + chance.between(-0.6, 0.6) * step[1];
    QTest::addRow("by chance, seed %d", seed) << step;
  }
}

}  // namespace

void TestLengths::sumsItsSegments_data() {
  QTest::addColumn<std::vector<dvec3>>("points");
  QTest::addColumn<double>("mm");
  QTest::newRow("3, 4, 5") << std::vector<dvec3>{{1, 1, 1}, {4, 5, 1}} << 5.0;
  QTest::newRow("in space") << std::vector<dvec3>{{0, 0, 0}, {2, 3, 6}} << 7.0;
  QTest::newRow("there and back") << std::vector<dvec3>{{0, 0, 0}, {2, 3, 6}, {0, 0, 0}} << 14.0;
  QTest::newRow("one place") << std::vector<dvec3>{{1, 2, 3}, {1, 2, 3}} << 0.0;
  QTest::newRow("one point") << std::vector<dvec3>{{1, 2, 3}} << 0.0;
  QTest::newRow("no points") << std::vector<dvec3>{} << 0.0;
}

void TestLengths::sumsItsSegments() {
  QFETCH(std::vector<dvec3>, points);
  QFETCH(double, mm);
  const Length length = lengthOf(points, grid(glm::dmat3(0.7)));
  QVERIFY(near(length.mm, mm));
  QVERIFY(std::isfinite(length.plusMinus));
}

// u^2 = (s1^2 + s2^2)/12, calculated by hand for voxels of 0.5 x 0.8 x 2.5 mm.
void TestLengths::isOffByTheVoxelsAlongIt_data() {
  QTest::addColumn<std::vector<dvec3>>("points");
  QTest::addColumn<double>("squares");  // sum of the squared voxel extents at all ends
  QTest::newRow("along i") << std::vector<dvec3>{{0, 0, 0}, {9, 0, 0}} << 2 * 0.5 * 0.5;
  QTest::newRow("along k, backwards") << std::vector<dvec3>{{0, 0, 9}, {0, 0, 1}} << 2 * 2.5 * 2.5;
  QTest::newRow("across") << std::vector<dvec3>{{0, 0, 0}, {6, 8, 0}}
                          << 2 * (0.6 * 0.5 * 0.6 * 0.5 + 0.8 * 0.8 * 0.8 * 0.8);
  QTest::newRow("at 45 degrees to the slices")
      << std::vector<dvec3>{{0, 0, 0}, {8, 0, 8}} << 2 * (0.5 * 0.5 + 2.5 * 2.5) / 2;
  QTest::newRow("a corner") << std::vector<dvec3>{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}
                            << 2 * 0.5 * 0.5 + 2 * 0.8 * 0.8;
  QTest::newRow("a point of a straight line")
      << std::vector<dvec3>{{0, 0, 0}, {3, 0, 0}, {9, 0, 0}} << 2 * 0.5 * 0.5;
  QTest::newRow("there and back") << std::vector<dvec3>{{0, 0, 0}, {3, 0, 0}, {0, 0, 0}} << 6 * 0.5 * 0.5;
  QTest::newRow("no direction: the longest") << std::vector<dvec3>{{1, 1, 1}, {1, 1, 1}} << 2 * 2.5 * 2.5;
}

void TestLengths::isOffByTheVoxelsAlongIt() {
  QFETCH(std::vector<dvec3>, points);
  QFETCH(double, squares);
  const Length length = lengthOf(points, grid({0.5, 0, 0, 0, 0.8, 0, 0, 0, 2.5}));
  QVERIFY(near(length.plusMinus, 2 * std::sqrt(squares / 12)));
}

void TestLengths::aSoftSurfaceAddsToBothEnds_data() {
  QTest::addColumn<double>("softMm");
  QTest::newRow("hard") << 0.0;
  QTest::newRow("a tenth") << 0.1;
  QTest::newRow("fog") << 8.0;
}

// `softMm` d is the middle half of a uniform distribution of width 2 d. Its variance d^2 / 3 is summed
// numerically here.
void TestLengths::aSoftSurfaceAddsToBothEnds() {
  QFETCH(double, softMm);
  constexpr int parts = 10000;
  double variance = 0;
  for (int n = 0; n < parts; ++n) {
    const double at = 2 * softMm * ((n + 0.5) / parts - 0.5);
    variance += at * at / parts;
  }
  const dvec3 ends[] = {dvec3(0), dvec3(0, 0, 9)};
  const Length length = lengthOf(ends, grid(glm::dmat3(0.7)), softMm);
  QCOMPARE(length.mm, 9.0);
  const double wanted = 2 * std::sqrt(2 * (0.7 * 0.7 / 12 + variance));
  QVERIFY(std::abs(length.plusMinus - wanted) < 1e-7 * wanted);
}

void TestLengths::holdsOnEveryGrid_data() { addGrids(); }

// Both ends of a known distance are rounded to voxel centres. The true distance must lie within the stated +-
// in 95 % of cases and hardly more. Sums of uniform errors have 95.4 % (many of them) to 96.6 % (two) within
// 2 u.
void TestLengths::holdsOnEveryGrid() {
  QFETCH(glm::dmat3, step);
  const VoxelGeometry geometry = grid(step);
  const dvec3 spacing = geometry.spacing();
  const double longest = std::max({spacing.x, spacing.y, spacing.z});
  Chance chance(7);
  constexpr int count = 20000;
  int covered = 0;
  for (int n = 0; n < count; ++n) {
    const dvec3 from = 100.0 * chance.vector();
    const dvec3 to = from + chance.between(20, 60) * longest * glm::normalize(chance.vector());
    std::vector<dvec3> seen;
    for (const dvec3 place : {from, to})
      seen.push_back(geometry.patientFromVoxel(glm::round(geometry.voxelFromPatient(place))));
    const Length length = lengthOf(seen, geometry);
    covered += std::abs(length.mm - glm::distance(from, to)) <= length.plusMinus;
  }
  const double share = double(covered) / count;
  QVERIFY2(share >= 0.95 && share <= 0.975, qPrintable(QString::number(share)));
}

void TestLengths::holdsForPolylinesOnEveryGrid_data() { addGrids(); }

// Polylines of 2 to 10 segments: straight ones, winding ones, and such that turn by any angle or back.
void TestLengths::holdsForPolylinesOnEveryGrid() {
  QFETCH(glm::dmat3, step);
  const VoxelGeometry geometry = grid(step);
  const dvec3 spacing = geometry.spacing();
  const double longest = std::max({spacing.x, spacing.y, spacing.z});
  for (const double turn : {0.0, 0.5, 100.0, -1.0}) {
    Chance chance(11);
    constexpr int count = 10000;
    int covered = 0;
    for (int n = 0; n < count; ++n) {
      std::vector<dvec3> places{100.0 * chance.vector()}, seen;
      dvec3 direction = glm::normalize(chance.vector());
      double mm = 0;
      for (int pieces = 2 + chance.below(9); pieces > 0; --pieces) {
        const double piece = chance.between(5, 60) * longest;
        places.push_back(places.back() + piece * direction);
        mm += piece;
        direction =
            turn < 0 ? -direction : glm::normalize(direction + turn * glm::normalize(chance.vector()));
      }
      for (const dvec3 place : places)
        seen.push_back(geometry.patientFromVoxel(glm::round(geometry.voxelFromPatient(place))));
      const Length length = lengthOf(seen, geometry);
      covered += std::abs(length.mm - mm) <= length.plusMinus;
    }
    const double share = double(covered) / count;
    QVERIFY2(share >= 0.95 && share <= 0.975, qPrintable(QStringLiteral("turn %1: %2").arg(turn).arg(share)));
  }
}

void TestLengths::angles_data() {
  QTest::addColumn<dvec3>("a");
  QTest::addColumn<dvec3>("b");
  QTest::addColumn<double>("degrees");
  QTest::newRow("right") << dvec3(2, 0, 0) << dvec3(0, 0, 5) << 90.0;
  QTest::newRow("none") << dvec3(1, 2, 3) << dvec3(2, 4, 6) << 0.0;
  QTest::newRow("straight") << dvec3(1, 2, 3) << dvec3(-1, -2, -3) << 180.0;
  QTest::newRow("obtuse") << dvec3(1, 0, 0) << dvec3(-1, 1, 0) << 135.0;
  QTest::newRow("sixty, out of the plane") << dvec3(1, 1, 0) << dvec3(0, 1, 1) << 60.0;
  QTest::newRow("hardly any") << dvec3(1, 0, 0) << dvec3(1, 1e-9, 0) << 1e-9 * 180 / std::acos(-1.0);
  QTest::newRow("long and short") << dvec3(1e8, 0, 0) << dvec3(1e-8, 1e-8, 0) << 45.0;
}

void TestLengths::angles() {
  QFETCH(dvec3, a);
  QFETCH(dvec3, b);
  QFETCH(double, degrees);
  QVERIFY(std::abs(*angleBetween(a, b) - degrees) <= 1e-12 * (1 + degrees));
  QVERIFY(std::abs(*angleBetween(b, a) - degrees) <= 1e-12 * (1 + degrees));
  const double cobb = std::min(degrees, 180 - degrees);
  QVERIFY(std::abs(*cobbAngle(a, b) - cobb) <= 1e-12 * (1 + degrees));
  QVERIFY(std::abs(*cobbAngle(a, -b) - cobb) <= 1e-12 * (1 + degrees));
}

void TestLengths::noAngleWithoutArms() {
  QVERIFY(!angleBetween({0, 0, 0}, {1, 0, 0}));
  QVERIFY(!cobbAngle({1, 0, 0}, {0, 0, 0}));
}

VOLUMEN_TEST(TestLengths);
#include "tst_lengths.moc"
