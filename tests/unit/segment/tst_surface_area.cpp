// Guards surface_area.h: the area of a mask's boundary against closed forms on every grid. Also guards the
// brick faces that it sums, and compares with a voxel-by-voxel smoothing.
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <glm/vector_relational.hpp>
#include <map>
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
  void edges_data();
  void edges();
  void thinParts();
  void bricksTouch();
  void isTheDefinition();
  void bordersOfTheGridAreBoundary();
  void cancelledEndsEarly();
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

Shape3 box(dvec3 edges, dvec3 along) {
  const dvec3 z = glm::normalize(along),
              x = glm::normalize(glm::cross(z, std::abs(z.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
  return [=, y = glm::cross(z, x)](dvec3 p) {
    const dvec3 q(glm::dot(p, x), glm::dot(p, y), glm::dot(p, z));
    return glm::all(glm::lessThanEqual(glm::abs(q), edges / 2.0));
  };
}

// The mask after a Gaussian along the axes of the grid, voxel by voxel.
class SmoothedTwin {
 public:
  SmoothedTwin(const BitMask& mask, double sigmaMm)
      : sigma_(sigmaMm / mask.geometry().spacing()),
        patientFromVoxel_(glm::transpose(glm::inverse(mask.geometry().patientFromVoxelStep))) {
    for (int k = 0; k < mask.size().z; ++k)
      for (int j = 0; j < mask.size().y; ++j)
        for (int i = 0; i < mask.size().x; ++i)
          if (mask.at({i, j, k})) voxels_.emplace_back(i, j, k);
    for (int a = 0; a < 3; ++a) {
      double sum = 0;
      for (int n = 0; n <= int(4 * sigma_[a]); ++n) {
        weights_[a].push_back(std::exp(-0.5 * n * n / (sigma_[a] * sigma_[a])));
        sum += (n ? 2 : 1) * weights_[a].back();
      }
      for (double& weight : weights_[a]) weight /= sum;
    }
  }

  // Returns the sum of the gradients at two voxels.
  dvec3 gradient(ivec3 a, ivec3 b) { return patientFromVoxel_ * (slopes(a) + slopes(b)); }

 private:
  double at(ivec3 v) {
    const auto [found, isNew] = values_.try_emplace({v.x, v.y, v.z}, 0.0);
    if (!isNew) return found->second;
    for (const ivec3 u : voxels_) {
      double product = 1;
      for (int a = 0; a < 3; ++a) {
        const auto n = std::size_t(std::abs(u[a] - v[a]));
        product *= n < weights_[a].size() ? weights_[a][n] : 0;
      }
      found->second += product;
    }
    return found->second;
  }
  dvec3 slopes(ivec3 v) {
    dvec3 slopes;
    for (int a = 0; a < 3; ++a) {
      ivec3 d(0);
      d[a] = 1;
      slopes[a] = 2.0 / 3 * (at(v + d) - at(v - d)) - (at(v + 2 * d) - at(v - 2 * d)) / 12;
    }
    return slopes;
  }

  dvec3 sigma_;
  std::array<std::vector<double>, 3> weights_;  // by distance in voxels
  dmat3 patientFromVoxel_;
  std::vector<ivec3> voxels_;
  std::map<std::array<int, 3>, double> values_;
};

double areaOfTwin(const BitMask& mask) {
  const auto isIn = [&](ivec3 v) { return isInGrid(v, mask.size()) && mask.at(v); };
  const AreaSmoothing smoothing = areaSmoothing(mask.geometry());
  SmoothedTwin narrow(mask, smoothing.narrowMm), wide(mask, smoothing.wideMm);
  double area = 0;
  for (const BrickFace& face : brickFaces(mask.geometry())) {
    const ivec3 reach = glm::abs(face.step);
    for (int k = -reach.z; k < mask.size().z + reach.z; ++k)
      for (int j = -reach.y; j < mask.size().y + reach.y; ++j)
        for (int i = -reach.x; i < mask.size().x + reach.x; ++i) {
          const ivec3 v(i, j, k), next = v + face.step;
          if (isIn(v) == isIn(next)) continue;
          const dvec3 a = narrow.gradient(v, next), b = wide.gradient(v, next);
          const auto seen = [&](dvec3 normal) {
            return std::abs(glm::dot(glm::normalize(normal), face.normal));
          };
          double share = 1;
          if (glm::length(a) > 1e-5) {
            share = seen(a);
            if (glm::dot(a, b) > 0.985 * glm::length(a) * glm::length(b))
              share += smoothing.share * (seen(a) - seen(b));
          }
          area += share * face.area;
        }
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

void TestSurfaceArea::edges_data() {
  QTest::addColumn<dmat3>("step");
  QTest::addColumn<double>("cylinders");
  QTest::addColumn<double>("boxes");
  QTest::newRow("even") << dmat3(1) << 0.01 << 0.03;
  QTest::newRow("0.7 x 0.7 x 2.5") << ctSlices << 0.02 << 0.05;
  QTest::newRow("0.7 x 0.7 x 5") << thickSlices << 0.065 << 0.12;
}

// Covers cylinders of 10 x 40 mm and boxes of 20 x 28 x 36 mm in all directions.
void TestSurfaceArea::edges() {
  QFETCH(dmat3, step);
  QFETCH(double, cylinders);
  QFETCH(double, boxes);
  for (const dvec3 along :
       {dvec3(0, 0, 1), {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}, {3, -1, 1}}) {
    const VoxelGeometry grid = gridAbout(step, 26);
    const double round = boundaryArea(maskOfShape(grid, cylinder(10, 40, along))) / (1000 * pi);
    QVERIFY2(std::abs(round - 1) < cylinders, qPrintable(QString::number(round)));
    const double flat = boundaryArea(maskOfShape(grid, box({20, 28, 36}, along))) / 4576;
    QVERIFY2(std::abs(flat - 1) < boxes, qPrintable(QString::number(flat)));
  }
}

// Covers a plate and a line of one voxel, which lose area only at their ends, and a shell of 3 mm.
void TestSurfaceArea::thinParts() {
  BitMask plate({.size = {40, 40, 3}}), line({.size = {50, 3, 3}});
  for (int j = 5; j < 35; ++j)
    for (int i = 5; i < 35; ++i) plate.set({i, j, 1});
  for (int i = 5; i < 45; ++i) line.set({i, 1, 1});
  const auto isNear = [](double found, double area, double within) {
    return std::abs(found / area - 1) < within;
  };
  QVERIFY(isNear(boundaryArea(plate), 2 * 900 + 4 * 30, 0.16));
  QVERIFY(isNear(boundaryArea(line), 4 * 40 + 2, 0.08));
  for (const dmat3& step : {dmat3(1), ctSlices}) {
    const Shape3 outer = ball(20), inner = ball(17);
    const BitMask shell = maskOfShape(gridAbout(step, 21), [&](dvec3 p) { return outer(p) && !inner(p); });
    QVERIFY(isNear(boundaryArea(shell), 4 * pi * (400 + 289), 0.01));
  }
}

// Each face is as large as the overlap of the bricks that touch there. All faces together cover the bricks.
void TestSurfaceArea::bricksTouch() {
  for (const Grid& g : allGrids()) {
    const dmat3& step = g.patientFromVoxelStep;
    const std::vector<BrickFace> faces = brickFaces({.size = {9, 9, 9}, .patientFromVoxelStep = step});
    const dvec3 x = faces.front().normal, z = faces.back().normal, y = glm::cross(z, x);
    const dvec3 edges(glm::dot(step[0], x), glm::dot(step[1], y), std::abs(glm::dot(step[2], z)));
    double sum[3] = {};
    for (const BrickFace& face : faces) {
      const dvec3 to = step * dvec3(face.step),
                  apart = glm::abs(dvec3(glm::dot(to, x), glm::dot(to, y), glm::dot(to, z)));
      const int across = std::abs(glm::dot(face.normal, x)) > 0.5   ? 0
                         : std::abs(glm::dot(face.normal, y)) > 0.5 ? 1
                                                                    : 2;
      double overlap = 1;
      for (int a = 0; a < 3; ++a)
        if (a == across)
          QVERIFY(std::abs(apart[a] - edges[a]) < 1e-9);
        else
          overlap *= std::max(0.0, edges[a] - apart[a]);
      QVERIFY2(std::abs(face.area - overlap) < 1e-5, g.name);
      sum[across] += face.area;
    }
    for (int a = 0; a < 3; ++a) QVERIFY(std::abs(sum[a] - edges[(a + 1) % 3] * edges[(a + 2) % 3]) < 1e-9);
  }
}

// Rows are longer than a word, with steps in both directions.
void TestSurfaceArea::isTheDefinition() {
  std::mt19937 random(3);
  for (const Grid& g : allGrids()) {
    for (int n = 0; n < 6; ++n) {
      VoxelGeometry grid = anyGrid(random, {70, 4, 3});
      grid.patientFromVoxelStep = g.patientFromVoxelStep;
      const BitMask mask = anyMask(random, grid);
      const double twin = areaOfTwin(mask), found = boundaryArea(mask);
      QVERIFY2(std::abs(found - twin) <= 1e-4 * twin, caseOf(n, mask).c_str());
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

void TestSurfaceArea::cancelledEndsEarly() {
  const BitMask all = inverted(BitMask({.size = {200, 150, 150}}));
  const CancelToken cancel;
  cancel.cancel();
  QCOMPARE(boundaryArea(all, cancel), 0.0);
}

VOLUMEN_TEST(TestSurfaceArea);
#include "tst_surface_area.moc"
