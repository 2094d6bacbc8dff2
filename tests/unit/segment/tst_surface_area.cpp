// Guards surface_area.h: the area of a mask's boundary by Crofton's formula, against closed forms on every
// grid, the known weights of even grids, and a twin that counts crossings one by one and weighs directions by
// points of the sphere.
#include <tbb/global_control.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "tests/fixtures/grids.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/segment/shape_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/surface_area.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dmat3, glm::dvec3, glm::ivec3;

class TestSurfaceArea : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void bodies_data();
  void bodies();
  void facesAlongTheGridAreSmaller_data();
  void facesAlongTheGridAreSmaller();
  void weightsOfAnEvenGrid();
  void isTheDefinition();
  void bordersOfTheGridAreBoundary();
};

namespace {

using std::numbers::pi;
const dmat3 thickSlices{0.7, 0, 0, 0, 0.7, 0, 0, 0, 5}, ctSlices{0.7, 0, 0, 0, 0.7, 0, 0, 0, 2.5};

std::vector<ivec3> halfOfNeighbours() {
  std::vector<ivec3> all;
  for (int k = -1; k <= 1; ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if (k > 0 || (k == 0 && (j > 0 || (j == 0 && i > 0)))) all.emplace_back(i, j, k);
  return all;
}

// The share of the sphere nearest to each direction or its opposite, by points spread evenly (a spiral).
std::vector<double> countedShares(const dmat3& step) {
  const std::vector<ivec3> directions = halfOfNeighbours();
  std::vector<double> shares(directions.size());
  constexpr int points = 200000;
  for (int n = 0; n < points; ++n) {
    const double z = 1 - (2 * n + 1.0) / points, turn = n * pi * (3 - std::sqrt(5.0));
    const dvec3 p(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
    std::size_t nearest = 0;
    double most = -1;
    for (std::size_t d = 0; d < directions.size(); ++d)
      if (const double cosine = std::abs(glm::dot(p, glm::normalize(step * dvec3(directions[d]))));
          cosine > most)
        most = cosine, nearest = d;
    shares[nearest] += 1.0 / points;
  }
  return shares;
}

double countedArea(const BitMask& mask, const std::vector<double>& shares) {
  const auto isIn = [&](ivec3 v) { return isInGrid(v, mask.size()) && mask.at(v); };
  const std::vector<ivec3> directions = halfOfNeighbours();
  double area = 0;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    int crossings = 0;
    for (int k = -1; k <= mask.size().z; ++k)
      for (int j = -1; j <= mask.size().y; ++j)
        for (int i = -1; i <= mask.size().x; ++i)
          crossings += isIn({i, j, k}) != isIn(ivec3(i, j, k) + directions[d]);
    const double length = glm::length(mask.geometry().patientFromVoxelStep * dvec3(directions[d]));
    area += 2 * shares[d] * crossings * mask.geometry().voxelVolume() / length;
  }
  return area;
}

}  // namespace

void TestSurfaceArea::bodies_data() {
  QTest::addColumn<dmat3>("step");
  QTest::addColumn<Shape3>("shape");
  QTest::addColumn<double>("reach");
  QTest::addColumn<double>("area");
  QTest::addColumn<double>("within");
  std::vector<Grid> all(std::begin(grids), std::end(grids));
  all.push_back({"0.7 x 0.7 x 2.5", ctSlices});
  all.push_back({"0.7 x 0.7 x 5", thickSlices});
  for (const Grid& g : all) {
    const dmat3& step = g.patientFromVoxelStep;
    QTest::addRow("ball of 10, %s", g.name) << step << ball(10) << 11.0 << 400 * pi << 0.01;
    QTest::addRow("ball of 20, %s", g.name) << step << ball(20) << 21.0 << 1600 * pi << 0.01;
    QTest::addRow("ellipsoid, %s", g.name) << step << ellipsoid({20, 15, 10}) << 21.0 << 2788.644 << 0.02;
    QTest::addRow("long ellipsoid, %s", g.name)
        << step << ellipsoid({10, 30, 10}) << 31.0 << 3089.372 << 0.02;
    QTest::addRow("tilted cylinder, %s", g.name)
        << step << cylinder(10, 40, {3, -1, 1}) << 23.0 << 1000 * pi << 0.02;
  }
  QTest::addRow("cylinder of 20") << dmat3(1) << cylinder(20, 80, {1, 2, 3}) << 46.0 << 4000 * pi << 0.02;
}

void TestSurfaceArea::bodies() {
  QFETCH(dmat3, step);
  QFETCH(Shape3, shape);
  QFETCH(double, reach);
  QFETCH(double, area);
  QFETCH(double, within);
  const double found = boundaryArea(maskOfShape(gridAbout(step, reach), shape));
  QVERIFY2(std::abs(found / area - 1) < within,
           qPrintable(QString::number(100 * (found / area - 1)) + QStringLiteral(" %")));
}

void TestSurfaceArea::facesAlongTheGridAreSmaller_data() {
  QTest::addColumn<dmat3>("step");
  QTest::addColumn<double>("smaller");
  QTest::newRow("even") << dmat3(1) << 0.05;
  QTest::newRow("0.7 x 0.7 x 2.5") << ctSlices << 0.13;
  QTest::newRow("0.7 x 0.7 x 5") << thickSlices << 0.16;
}

// What the header says of them: a cylinder upright on the slices, a fifth of whose boundary lies along them.
void TestSurfaceArea::facesAlongTheGridAreSmaller() {
  QFETCH(dmat3, step);
  QFETCH(double, smaller);
  const double found =
      boundaryArea(maskOfShape(gridAbout(step, 23), cylinder(10, 40, {0, 0, 1}))) / (1000 * pi);
  QVERIFY2(found < 1 && found > 1 - smaller, qPrintable(QString::number(found)));
}

// Of one voxel every line through it enters and leaves. The weights: Ohser and Schladitz, 3D Images of
// Materials Structures (2009), table 5.1.
void TestSurfaceArea::weightsOfAnEvenGrid() {
  BitMask one({.size = {5, 4, 3}, .patientFromVoxelStep = dmat3(2)});
  one.set({2, 2, 1});
  const double perLine = 3 * 0.09156 + 6 * 0.07396 / std::sqrt(2.0) + 4 * 0.07039 / std::sqrt(3.0);
  const double found = boundaryArea(one);
  QVERIFY2(std::abs(found - 4 * 4 * perLine) < 2e-3, qPrintable(QString::number(found)));
}

// The spiral's points tell shares to about 1e-4 of the sphere.
void TestSurfaceArea::isTheDefinition() {
  std::mt19937 random(3);
  for (const Grid& g : grids) {
    const std::vector<double> shares = countedShares(g.patientFromVoxelStep);
    for (int n = 0; n < 40; ++n) {
      VoxelGeometry grid = anyGrid(random, {70, 6, 5});
      grid.patientFromVoxelStep = g.patientFromVoxelStep;
      const BitMask mask = anyMask(random, grid);
      const double twin = countedArea(mask, shares), found = boundaryArea(mask);
      QVERIFY2(std::abs(found - twin) <= 2e-3 * twin, caseOf(n, mask).c_str());
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      QCOMPARE(boundaryArea(mask), found);
    }
  }
}

void TestSurfaceArea::bordersOfTheGridAreBoundary() {
  const BitMask all = inverted(BitMask({.size = {64, 7, 5}}));
  BitMask inside({.size = {70, 10, 9}});
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 7; ++j)
      for (int i = 0; i < 64; ++i) inside.set({i + 3, j + 1, k + 2});
  QCOMPARE(boundaryArea(all), boundaryArea(inside));
  QCOMPARE(boundaryArea(BitMask({.size = {64, 7, 5}})), 0.0);
}

VOLUMEN_TEST(TestSurfaceArea);
#include "tst_surface_area.moc"
