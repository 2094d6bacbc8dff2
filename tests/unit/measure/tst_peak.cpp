// Guards SUVpeak (FIELD): the largest mean over balls of 1 ml about the voxels of a region. Voxels count by
// their share inside the ball. Compares with closed forms and brute force.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/measure/measure.h"
#include "viewer/measure/region.h"
#include "viewer/measure/scaled.h"

using namespace volumen;
using namespace volumen::tests;
using glm::dvec3;

class TestPeak : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theBallHoldsAMillilitre_data();
  void theBallHoldsAMillilitre();
  void closedForms_data();
  void closedForms();
  void aRampIsItsCentre();
  void isTheDefinition_data();
  void isTheDefinition();
  void aboutVoxelsOfAnyShape();
  void outsideAndPaddingDoNotCount();
  void onlyOfSuv();
  void anotherSeriesInTheSameRegion_data();
  void anotherSeriesInTheSameRegion();
};

namespace {

Shape squareAbout(dvec3 centre, double half) {
  Shape shape;
  shape.kind = ShapeKind::rectangle;
  shape.plane = ShapePlane{centre, {1, 0, 0}, {0, 1, 0}};
  shape.points = {centre - dvec3(half, half, 0), centre + dvec3(half, half, 0)};
  return shape;
}

// Returns the share of a voxel inside a ball about another voxel's centre, counted on 20^3 points.
double countedShare(dvec3 step, const glm::dmat3& grid, double radius) {
  constexpr int n = 20;
  int inside = 0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const dvec3 p = grid * (step + (dvec3(i, j, k) + 0.5) / double(n) - 0.5);
        inside += glm::dot(p, p) <= radius * radius;
      }
  return double(inside) / (n * n * n);
}

using BallShares = std::map<std::array<int, 3>, double>;

// Returns the shares of all voxels within reach of a ball of 1 ml. None is farther away than the radius plus
// the sum of a voxel's edges.
BallShares countedShares(const glm::dmat3& grid) {
  double diagonal = 0;
  for (int a = 0; a < 3; ++a) diagonal += glm::length(grid[a]);
  BallShares shares;
  constexpr int reach = 22;
  for (int k = -reach; k <= reach; ++k)
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i) {
        if (glm::length(grid * dvec3(i, j, k)) > peakRadius + diagonal) continue;
        if (const double share = countedShare({i, j, k}, grid, peakRadius); share > 0)
          shares[{i, j, k}] = share;
      }
  return shares;
}

const double tripled = 3;  // factor from the fixtures' grids to voxel sizes of PET

}  // namespace

void TestPeak::theBallHoldsAMillilitre_data() {
  QTest::addColumn<glm::dmat3>("grid");
  for (const Grid& g : grids) QTest::newRow(g.name) << g.patientFromVoxelStep;
  QTest::newRow("4 mm") << glm::dmat3(4);
  QTest::newRow("PET, 5.47 x 5.47 x 3.27 mm") << glm::dmat3(5.47, 0, 0, 0, 5.47, 0, 0, 0, 3.27);
  QTest::newRow("one voxel holds it") << glm::dmat3(30);
}

// The shares must add up to 1000 mm^3 to within 0.1 %. Each share may differ from the counted one by one of
// the voxel's 20 layers.
void TestPeak::theBallHoldsAMillilitre() {
  QFETCH(glm::dmat3, grid);
  QVERIFY(std::abs(peakRadius - 6.2035) < 1e-4);
  VoxelGeometry geometry;
  geometry.patientFromVoxelStep = grid;
  double sum = 0;
  for (const BallVoxel& voxel : ballVoxels(geometry, peakRadius)) {
    sum += voxel.share;
    QVERIFY(voxel.share > 0 && voxel.share < 1 + 1e-9);
    QVERIFY(std::abs(voxel.share - countedShare(dvec3(voxel.step), grid, peakRadius)) < 0.05);
  }
  QVERIFY2(std::abs(sum * geometry.voxelVolume() - 1000) < 1, qPrintable(QString::number(sum)));
}

void TestPeak::closedForms_data() {
  QTest::addColumn<double>("sigma");  // s of a Gaussian exp(-r^2 / 2 s^2); 0 for the cone 1 - r/20
  QTest::addColumn<double>("spacing");
  QTest::addColumn<double>("peak");
  QTest::addColumn<double>("within");
  // A voxel of h mm has one value. The mean of r^2 in it exceeds that at its centre by h^2/4. For a Gaussian
  // that is an error of h^2/4 / (2 s^2), at most 0.005 at 1 mm and 0.045 at 3 mm, times its height of 0.64.
  for (const auto& [sigma, peak] :
       {std::pair(5.0, 0.64333), {8.0, 0.83756}, {10.0, 0.89210}, {15.0, 0.95022}, {0.0, 0.76737}}) {
    QTest::addRow("sigma %g, 1 mm", sigma) << sigma << 1.0 << peak << 0.005;
    QTest::addRow("sigma %g, 3 mm", sigma) << sigma << 3.0 << peak << 0.03;
  }
}

void TestPeak::closedForms() {
  QFETCH(double, sigma);
  QFETCH(double, spacing);
  QFETCH(double, peak);
  QFETCH(double, within);
  const int n = int(39 / spacing) | 1;
  const dvec3 middle((n - 1) / 2.0);
  const VolumePtr volume = volumeOf<float>(glm::ivec3(n), glm::dmat3(spacing), [&](dvec3 x) {
    const double r = spacing * glm::length(x - middle);
    return sigma > 0 ? std::exp(-r * r / (2 * sigma * sigma)) : 1 - r / 20;
  });
  const auto found = regionPeak(squareAbout({0, 0, 0}, 8), *volume);
  QVERIFY(found.has_value());
  QVERIFY2(std::abs(found->mean - peak) < within, qPrintable(QString::number(found->mean)));
  QVERIFY(glm::length(found->centre) < 1e-9);
}

// A ball is symmetric about its voxel, so that the mean of a ramp is the centre's value.
void TestPeak::aRampIsItsCentre() {
  const VolumePtr volume =
      volumeOf<float>({25, 25, 25}, glm::dmat3(2, 0, 0, 0, 2, 0, 0, 0, 3), [](dvec3 x) { return 10 + x.x; });
  const auto found = regionPeak(squareAbout({0, 0, 0}, 6.5), *volume);
  QVERIFY(std::abs(found->mean - 25) < 1e-9);  // x = 6 mm is voxel 15
  QVERIFY(std::abs(found->centre.x - 6) < 1e-9);
}

void TestPeak::isTheDefinition_data() {
  QTest::addColumn<glm::dmat3>("grid");
  QTest::addColumn<quint64>("seed");
  for (const Grid& g : grids)
    for (quint64 seed = 1; seed <= 4; ++seed)
      QTest::addRow("%s, seed %llu", g.name, seed) << tripled * g.patientFromVoxelStep << seed;
}

// Evaluates each ball separately with counted shares. As values are between 0 and 1, errors of counting
// change no mean by 0.01.
void TestPeak::isTheDefinition() {
  QFETCH(glm::dmat3, grid);
  QFETCH(quint64, seed);
  static std::map<double, BallShares> known;  // keyed by two elements in which the grids differ
  BallShares& shares = known[grid[0][0] + 100 * grid[1][1]];
  if (shares.empty()) shares = countedShares(grid);
  Chance chance(seed);
  const glm::ivec3 size(11, 9, 8);
  const VolumePtr volume = volumeOf<float>(size, grid, [&](dvec3) { return chance.share(); });
  const Shape region = squareAbout(2.0 * chance.vector(), chance.between(3, 9));
  double best = -1;
  int balls = 0;
  forEachVoxelOf(region, *volume, [&](glm::ivec3 about, double) {
    double sum = 0, all = 0;
    for (const auto& [step, share] : shares) {
      const glm::ivec3 x = about + glm::ivec3(step[0], step[1], step[2]);
      bool inside = true;
      for (int a = 0; a < 3; ++a) inside = inside && x[a] >= 0 && x[a] < size[a];
      if (!inside) continue;
      sum += share * double(volume->value(x.x, x.y, x.z));
      all += share;
    }
    ++balls;
    best = std::max(best, sum / all);
  });
  const auto found = regionPeak(region, *volume);
  QCOMPARE(found.has_value(), balls > 0);
  if (!found) return;
  QVERIFY2(std::abs(found->mean - best) < 0.01,
           qPrintable(QStringLiteral("%1, not %2").arg(found->mean).arg(best)));
}

// All voxels of a region give the region's result. A few voxels give the largest of their own balls, and the
// first of equal ones.
void TestPeak::aboutVoxelsOfAnyShape() {
  Chance chance(12);
  const VolumePtr volume = volumeOf<float>({14, 12, 9}, glm::dmat3(3), [&](dvec3) { return chance.share(); });
  const Shape region = squareAbout({1, 2, 0}, 11);
  std::vector<glm::ivec3> voxels;
  forEachVoxelOf(region, *volume, [&](glm::ivec3 voxel, double) { voxels.push_back(voxel); });
  QVERIFY(voxels.size() > 30);
  QCOMPARE(peakAbout(voxels, *volume)->mean, regionPeak(region, *volume)->mean);
  double largest = 0;
  for (const glm::ivec3 voxel : {glm::ivec3(3, 3, 3), {9, 4, 5}, {0, 0, 0}})
    largest = std::max(largest, peakAbout(std::array{voxel}, *volume)->mean);
  QCOMPARE(peakAbout(std::array{glm::ivec3(3, 3, 3), glm::ivec3(9, 4, 5), glm::ivec3(0)}, *volume)->mean,
           largest);
  QVERIFY(!peakAbout({}, *volume));
  const VolumePtr even = volumeOf<float>({14, 12, 9}, glm::dmat3(3), [](dvec3) { return 2; });
  const dvec3 first = even->geometry().patientFromVoxel({9, 4, 5});
  QVERIFY(peakAbout(std::array{glm::ivec3(9, 4, 5), glm::ivec3(3, 3, 3)}, *even)->centre == first);
}

void TestPeak::outsideAndPaddingDoNotCount() {
  VolumeParts parts;
  parts.geometry.size = {9, 9, 9};
  parts.geometry.patientFromVoxelStep *= 4.0;
  parts.geometry.origin = dvec3(-16);
  std::vector<float> values(9 * 9 * 9, 5.0f);
  for (std::size_t n = 0; n < values.size(); ++n)
    if (n % 9 < 4) values[n] = -1000;
  parts.values = std::move(values);
  parts.attributes.padding = ValueRange{-1000, -1000};
  const VolumePtr volume = volumeFrom(std::move(parts));
  // Covers the last corner and the border of the padding. Every ball must contain only fives.
  for (const dvec3 at : {dvec3(16, 16, 16), dvec3(0, 0, 0)})
    QVERIFY(std::abs(regionPeak(squareAbout(at, 3), *volume)->mean - 5) < 1e-12);
  QVERIFY(!regionPeak(squareAbout({-12, 0, 0}, 3), *volume));
  CancelToken cancel;
  cancel.cancel();
  QVERIFY(!regionPeak(squareAbout({0, 0, 0}, 3), *volume, cancel));
}

void TestPeak::onlyOfSuv() {
  const VolumePtr volume = volumeOf<float>({20, 20, 20}, glm::dmat3(2), [](dvec3) { return 3; });
  const Shape square = squareAbout({0, 0, 0}, 6);
  QVERIFY(!measure(square, *volume, "HU")->peak);
  QVERIFY(!measure(square, *volume, "BQML")->peak);
  const Result<Measured> suv = scaled(measure(square, *volume, "SUVbw"), 0.5);
  QVERIFY(std::abs(suv->peak->mean - 1.5) < 1e-12);
  QCOMPARE(suv->values->max, 1.5);
  // Without a known pixel size in mm there is no ball of 1 ml.
  VolumeParts parts;
  parts.geometry.size = {20, 20, 20};
  parts.geometry.calibrated = false;
  parts.values = std::vector<float>(8000, 1.0f);
  QVERIFY(!regionPeak(squareAbout({10, 10, 10}, 4), *volumeFrom(std::move(parts))));
}

void TestPeak::anotherSeriesInTheSameRegion_data() {
  QTest::addColumn<glm::dmat3>("grid");
  QTest::addColumn<bool>("moved");
  for (const Grid& g : grids)
    for (const bool moved : {false, true})
      QTest::addRow("%s%s", g.name, moved ? ", moved" : "") << tripled * g.patientFromVoxelStep << moved;
}

// The result equals that of the region drawn on the other series, in its own patient space.
void TestPeak::anotherSeriesInTheSameRegion() {
  QFETCH(glm::dmat3, grid);
  QFETCH(bool, moved);
  Chance chance(5);
  const VolumePtr first = volumeOf<float>({30, 30, 30}, glm::dmat3(1), [](dvec3 x) { return x.x; });
  const VolumePtr second = volumeOf<float>({13, 12, 11}, grid, [&](dvec3) { return chance.share(); });
  Rigid there;
  if (moved) there = {glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1), {3, -2, 1}};  // a quarter turn about z
  const Shape region = squareAbout({1, 2, 0.3}, 9);
  Measured both = *measure(region, *first, "HU");
  addOther(both, region, *second, there, "SUVbw");
  Shape onSecond = region;
  for (dvec3& p : onSecond.points) p = there(p);
  onSecond.plane = ShapePlane{there(region.plane->centre), there.rotation * region.plane->right,
                              there.rotation * region.plane->down};
  const Measured alone = *measure(onSecond, *second, "SUVbw");
  QCOMPARE(both.other.has_value(), true);
  QCOMPARE(both.other->values->n, alone.values->n);
  QCOMPARE(both.other->values->mean, alone.values->mean);
  QCOMPARE(both.other->values->max, alone.values->max);
  QCOMPARE(both.other->peak->mean, alone.peak->mean);
  QCOMPARE(both.other->unit, std::string("SUVbw"));
  scaleOther(both, 2);
  QCOMPARE(both.other->values->sd, 2 * alone.values->sd);
  QCOMPARE(both.other->peak->mean, 2 * alone.peak->mean);
  // The region's own values are still those of the first series alone.
  QCOMPARE(both.values->mean, measure(region, *first, "HU")->values->mean);
}

VOLUMEN_TEST(TestPeak);
#include "tst_peak.moc"
