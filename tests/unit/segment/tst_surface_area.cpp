// Guards surface_area.h: the area of a mask's boundary by Crofton's formula, against closed forms on every
// grid, what its weights have to fulfil, and a twin that counts crossings one by one.
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
  void edgesAreCut_data();
  void edgesAreCut();
  void planesOfAllDirections();
  void directionsAreApart();
  void isTheDefinition();
  void bordersOfTheGridAreBoundary();
};

namespace {

using std::numbers::pi;
const dmat3 thickSlices{0.7, 0, 0, 0, 0.7, 0, 0, 0, 5}, ctSlices{0.7, 0, 0, 0, 0.7, 0, 0, 0, 2.5};

const Grid furtherGrids[] = {{"0.7 x 0.7 x 2.5", ctSlices},
                             {"0.7 x 0.7 x 5", thickSlices},
                             {"0.7 x 0.7 x 5, sheared", {0.7, 0, 0, 0, 0.7, 0, 0.5, 1.8, 5}},
                             {"sheared by 45 degrees", {1, 0, 0, 0, 1, 0, 1, 0, 1}}};

std::vector<Grid> allGrids() {
  std::vector<Grid> all(std::begin(grids), std::end(grids));
  all.insert(all.end(), std::begin(furtherGrids), std::end(furtherGrids));
  return all;
}

double countedArea(const BitMask& mask, const std::vector<CrossingDirection>& directions) {
  const auto isIn = [&](ivec3 v) { return isInGrid(v, mask.size()) && mask.at(v); };
  double area = 0;
  for (const CrossingDirection& d : directions) {
    int crossings = 0;
    const ivec3 reach = glm::abs(d.step);
    for (int k = -reach.z; k < mask.size().z; ++k)
      for (int j = -reach.y; j < mask.size().y + reach.y; ++j)
        for (int i = -reach.x; i < mask.size().x + reach.x; ++i)
          crossings += isIn({i, j, k}) != isIn(ivec3(i, j, k) + d.step);
    const double length = glm::length(mask.geometry().patientFromVoxelStep * dvec3(d.step));
    area += 2 * d.weight * crossings * mask.geometry().voxelVolume() / length;
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
  for (const Grid& g : allGrids()) {
    const dmat3& step = g.patientFromVoxelStep;
    QTest::addRow("ball of 10, %s", g.name) << step << ball(10) << 11.0 << 400 * pi << 0.012;
    QTest::addRow("ball of 20, %s", g.name) << step << ball(20) << 21.0 << 1600 * pi << 0.005;
    QTest::addRow("ellipsoid, %s", g.name) << step << ellipsoid({20, 15, 10}) << 21.0 << 2788.644 << 0.015;
    for (int a = 0; a < 3; ++a) {
      dvec3 halfAxes(10);
      halfAxes[a] = 30;
      QTest::addRow("long ellipsoid along %c, %s", 'x' + a, g.name)
          << step << ellipsoid(halfAxes) << 31.0 << 3089.372 << 0.015;
    }
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

void TestSurfaceArea::edgesAreCut_data() {
  QTest::addColumn<dmat3>("step");
  QTest::addColumn<double>("smaller");
  QTest::newRow("even") << dmat3(1) << 0.045;
  QTest::newRow("0.7 x 0.7 x 2.5") << ctSlices << 0.075;
  QTest::newRow("0.7 x 0.7 x 5") << thickSlices << 0.095;
}

// What segment.md says of them: cylinders of 10 x 40 mm come out smaller, whichever way they run.
void TestSurfaceArea::edgesAreCut() {
  QFETCH(dmat3, step);
  QFETCH(double, smaller);
  for (const dvec3 along :
       {dvec3(0, 0, 1), {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}, {3, -1, 1}}) {
    const double found =
        boundaryArea(maskOfShape(gridAbout(step, 23), cylinder(10, 40, along))) / (1000 * pi);
    QVERIFY2(found < 1 && found > 1 - smaller, qPrintable(QString::number(found)));
  }
}

// Crofton: the directions that cross a plane, weighted by the cosine, add up to 1/2.
void TestSurfaceArea::planesOfAllDirections() {
  std::mt19937 random(17);
  std::normal_distribution<double> part;
  for (const Grid& g : allGrids()) {
    const auto directions =
        crossingDirections({.size = {9, 9, 9}, .patientFromVoxelStep = g.patientFromVoxelStep});
    double mean = 0;
    constexpr int planes = 4000;
    for (int n = 0; n < planes; ++n) {
      const dvec3 normal = glm::normalize(dvec3(part(random), part(random), part(random)));
      double sum = 0;
      for (const CrossingDirection& d : directions)
        sum +=
            2 * d.weight * std::abs(glm::dot(normal, glm::normalize(g.patientFromVoxelStep * dvec3(d.step))));
      QVERIFY2(sum > 0.78 && sum < 1.07,
               qPrintable(QStringLiteral("%1: %2").arg(QLatin1String(g.name)).arg(sum)));
      mean += sum / planes;
    }
    QVERIFY2(std::abs(mean - 1) < 0.005,
             qPrintable(QStringLiteral("%1: %2").arg(QLatin1String(g.name)).arg(mean)));
  }
}

void TestSurfaceArea::directionsAreApart() {
  for (const Grid& g : allGrids()) {
    const auto all = crossingDirections({.size = {9, 9, 9}, .patientFromVoxelStep = g.patientFromVoxelStep});
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        const dvec3 u = glm::normalize(g.patientFromVoxelStep * dvec3(all[a].step)),
                    v = glm::normalize(g.patientFromVoxelStep * dvec3(all[b].step));
        QVERIFY(std::abs(glm::dot(u, v)) <= std::cos(8 * pi / 180));
      }
    QVERIFY(all.size() >= 9 && all.size() <= 100);
  }
}

// Rows of more than a word, steps to both sides.
void TestSurfaceArea::isTheDefinition() {
  std::mt19937 random(3);
  for (const Grid& g : allGrids()) {
    for (int n = 0; n < 40; ++n) {
      VoxelGeometry grid = anyGrid(random, {70, 6, 5});
      grid.patientFromVoxelStep = g.patientFromVoxelStep;
      const BitMask mask = anyMask(random, grid);
      const double twin = countedArea(mask, crossingDirections(grid)), found = boundaryArea(mask);
      QVERIFY2(std::abs(found - twin) <= 1e-9 * twin, caseOf(n, mask).c_str());
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
