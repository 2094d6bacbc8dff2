// Guards morphology with balls in mm: on grids of every kind, voxels whose centres lie within the radius are
// found, one by one.
#include <tbb/global_control.h>

#include <QElapsedTimer>
#include <algorithm>
#include <limits>

#include "tests/fixtures/seeds.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/morphology.h"

using namespace volumen;
using namespace volumen::tests;

class TestMorphology : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theVoxelsAreThoseOfTheDistances();
  void closingGoesOnBeyondTheGrid();
  void aBallOfWholeStepsHoldsItsEnds_data();
  void aBallOfWholeStepsHoldsItsEnds();
  void aBallHasItsVolume_data();
  void aBallHasItsVolume();
  void theBorderTakesNothing();
  void aSliceIsClosedInItself();
  void lawsOfOpeningAndClosing();
  void radiiOfNoSize_data();
  void radiiOfNoSize();
  void sameForAnyNumberOfThreads();
  void cancelledEndsEarly();
};

namespace {

bool isNear(const VoxelGeometry& grid, glm::ivec3 a, glm::ivec3 b, double radius) {
  return glm::length(grid.patientFromVoxelStep * glm::dvec3(b - a)) <= radius * (1 + 1e-9);
}

// Grows by the distances from every voxel to every other.
BitMask grownSlowly(const BitMask& mask, double radius) {
  BitMask made(mask.geometry());
  const auto voxels = voxelsOf(mask.geometry());
  for (const glm::ivec3 a : voxels)
    made.set(a, std::ranges::any_of(voxels, [&](glm::ivec3 b) {
               return mask.at(b) && isNear(mask.geometry(), a, b, radius);
             }));
  return made;
}

BitMask shrunkSlowly(const BitMask& mask, double radius) {
  BitMask made(mask.geometry());
  const auto voxels = voxelsOf(mask.geometry());
  for (const glm::ivec3 a : voxels)
    made.set(a, std::ranges::all_of(voxels, [&](glm::ivec3 b) {
               return mask.at(b) || !isNear(mask.geometry(), a, b, radius);
             }));
  return made;
}

// Returns a random radius, sometimes a whole number of steps.
double anyRadius(std::mt19937& random, const VoxelGeometry& grid) {
  const double step = grid.spacing()[int(random() % 3)];
  return random() % 3 == 0 ? step * int(random() % 5) : double(random() % 5000) / 1000;
}

}  // namespace

void TestMorphology::theVoxelsAreThoseOfTheDistances() {
  const Seeds seeds = seedsOf(500, 20000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const VoxelGeometry grid = anyGrid(random, {random() % 2 ? 70 : 12, 6, 5});
    const BitMask mask = anyMask(random, grid);
    const double radius = anyRadius(random, grid);
    const std::string told = caseOf(seed, mask) + ", radius " + std::to_string(radius);
    const BitMask more = grownSlowly(mask, radius), less = shrunkSlowly(mask, radius);
    QVERIFY2(grown(mask, radius) == more, told.c_str());
    QVERIFY2(shrunk(mask, radius) == less, told.c_str());
    QVERIFY2(opened(mask, radius) == grownSlowly(less, radius), told.c_str());
    QVERIFY2(shell(mask, radius) == subtracted(mask, less), told.c_str());
  }
}

// A voxel belongs to the closing if the whole ball about it is near the mask, even beyond the grid.
void TestMorphology::closingGoesOnBeyondTheGrid() {
  const Seeds seeds = seedsOf(150, 8000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const VoxelGeometry grid = anyGrid(random, {random() % 2 ? 66 : 9, 5, 4});
    const BitMask mask = anyMask(random, grid);
    const double radius = anyRadius(random, grid) * 0.6;
    glm::ivec3 around(0);
    for (int axis = 0; axis < 3; ++axis)
      if (grid.size[axis] > 1)
        around[axis] = 2 + int(radius * glm::length(glm::transpose(grid.voxelFromPatientStep())[axis]));
    VoxelGeometry larger = grid;
    larger.size += 2 * around;
    BitMask inside(larger);
    for (const glm::ivec3 v : voxelsOf(grid)) inside.set(v + around, mask.at(v));
    const BitMask near = grownSlowly(inside, radius), made = closed(mask, radius);
    const std::string told = caseOf(seed, mask) + ", radius " + std::to_string(radius);
    const auto all = voxelsOf(larger);
    const auto holds = [&](glm::ivec3 v) {
      return std::ranges::all_of(
          all, [&](glm::ivec3 b) { return near.at(b) || !isNear(grid, v + around, b, radius); });
    };
    QVERIFY2(isExactly(made, holds), told.c_str());
  }
}

void TestMorphology::aBallOfWholeStepsHoldsItsEnds_data() {
  QTest::addColumn<double>("step");
  QTest::addColumn<int>("steps");
  // None of these products is exact in doubles.
  for (const double step : {0.1, 0.3, 0.7, 1.1, 1.0 / 3})
    for (const int steps : {1, 3, 6, 7}) QTest::addRow("%d steps of %.3g mm", steps, step) << step << steps;
}

void TestMorphology::aBallOfWholeStepsHoldsItsEnds() {
  QFETCH(double, step);
  QFETCH(int, steps);
  const double radius = QString::number(step * steps, 'g', 12).toDouble();
  const glm::ivec3 middle(8);
  for (int axis = 0; axis < 3; ++axis) {
    BitMask mask({.size = glm::ivec3(17), .patientFromVoxelStep = glm::dmat3(step)});
    mask.set(middle);
    const BitMask made = grown(mask, radius);
    glm::ivec3 along(0);
    along[axis] = steps;
    QVERIFY(made.at(middle + along) && made.at(middle - along));
    along[axis] = steps + 1;
    QVERIFY(!made.at(middle + along) && !made.at(middle - along));
  }
}

void TestMorphology::aBallHasItsVolume_data() {
  QTest::addColumn<int>("grid");
  for (int n = 0; n < int(std::size(grids)); ++n) QTest::newRow(grids[n].name) << n;
}

// Expects 4/3 pi r^3 at 9 mm to 3 %, as only voxels of the surface may differ.
void TestMorphology::aBallHasItsVolume() {
  QFETCH(int, grid);
  BitMask mask({.size = glm::ivec3(75), .patientFromVoxelStep = grids[grid].patientFromVoxelStep});
  mask.set(glm::ivec3(37));
  const double volume = double(grown(mask, 9).count()) * mask.geometry().voxelVolume();
  QVERIFY2(std::abs(volume / (4.0 / 3 * std::numbers::pi * 729) - 1) < 0.03,
           qPrintable(QString::number(volume)));
}

void TestMorphology::theBorderTakesNothing() {
  const BitMask all = inverted(BitMask({.size = {70, 8, 6}}));
  QVERIFY(shrunk(all, 3) == all);
  QVERIFY(opened(all, 3) == all);
  QVERIFY(closed(all, 3) == all);
  QVERIFY(shell(all, 3).empty());
  // The space between a wall and the border two voxels away is not closed. An equally wide gap between two
  // walls is.
  const VoxelGeometry grid{.size = {70, 8, 6}};
  BitMask walls(grid);
  for (const glm::ivec3 v : voxelsOf(grid)) walls.set(v, v.x == 2 || v.x == 5);
  const BitMask made = closed(walls, 2);
  QVERIFY(!made.at({1, 4, 3}) && !made.at({6, 4, 3}));
  QVERIFY(made.at({3, 4, 3}) && made.at({4, 4, 3}));
}

void TestMorphology::aSliceIsClosedInItself() {
  const VoxelGeometry grid{.size = {30, 20, 1}};
  BitMask ring(grid);
  for (const glm::ivec3 v : voxelsOf(grid)) ring.set(v, glm::max(std::abs(v.x - 12), std::abs(v.y - 9)) == 2);
  QVERIFY(!ring.at({12, 9, 0}));
  QVERIFY(closed(ring, 3).at({12, 9, 0}));
}

void TestMorphology::lawsOfOpeningAndClosing() {
  const Seeds seeds = seedsOf(300, 10000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const VoxelGeometry grid = anyGrid(random, {140, 20, 12});
    const BitMask mask = anyMask(random, grid);
    const double radius = anyRadius(random, grid);
    const std::string told = caseOf(seed, mask) + ", radius " + std::to_string(radius);
    const BitMask less = opened(mask, radius), more = closed(mask, radius);
    QVERIFY2(subtracted(less, mask).empty() && subtracted(mask, more).empty(), told.c_str());
    QVERIFY2(opened(less, radius) == less, told.c_str());
    QVERIFY2(closed(more, radius) == more, told.c_str());
    QVERIFY2(shrunk(inverted(mask), radius) == inverted(grown(mask, radius)), told.c_str());
  }
}

void TestMorphology::radiiOfNoSize_data() {
  QTest::addColumn<double>("radius");
  QTest::newRow("0") << 0.0;
  QTest::newRow("smaller than every step") << 0.49;
  QTest::newRow("no number") << std::numeric_limits<double>::quiet_NaN();
}

void TestMorphology::radiiOfNoSize() {
  QFETCH(double, radius);
  std::mt19937 random(2);
  for (const Grid& kind : grids) {
    VoxelGeometry grid{.size = {70, 5, 4}, .patientFromVoxelStep = kind.patientFromVoxelStep};
    const BitMask mask = anyMask(random, grid), none(grid);
    for (const auto work : {grown, shrunk, closed, opened}) {
      QVERIFY(work(mask, radius, {}) == mask);
      QVERIFY(work(none, radius, {}) == none);
    }
    QVERIFY(shell(mask, radius).empty());
  }
  // The radius may exceed the grid.
  for (const double large : {1000.0, std::numeric_limits<double>::infinity()}) {
    BitMask one({.size = {9, 4, 3}});
    QVERIFY(grown(one, large).empty());
    one.set({4, 2, 1});
    QCOMPARE(grown(one, large).count(), one.geometry().voxelCount());
    QVERIFY(shrunk(one, large).empty());
    QVERIFY(opened(one, large).empty());
    QVERIFY(closed(one, large) == one);
  }
}

void TestMorphology::sameForAnyNumberOfThreads() {
  std::mt19937 random(5);
  VoxelGeometry grid{.size = {130, 60, 50}, .patientFromVoxelStep = grids[3].patientFromVoxelStep};
  BitMask mask(grid);
  for (int n = 0; n < 4000; ++n) mask.set({int(random() % 130u), int(random() % 60u), int(random() % 50u)});
  const auto all = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return std::tuple(grown(mask, 2), closed(mask, 2), shrunk(grown(mask, 3), 2));
  };
  const auto one = all(1);
  QVERIFY(one == all(2));
  QVERIFY(one == all(7));
}

void TestMorphology::cancelledEndsEarly() {
  const CancelToken cancel;
  cancel.cancel();
  BitMask mask({.size = {400, 400, 40}});
  for (int n = 0; n < 40; ++n) mask.set({10 * n, 10 * n, n});
  QElapsedTimer timer;
  timer.start();
  QVERIFY(grown(mask, 150, cancel) != grown(mask, 1));
  // Without cancelling this takes a minute.
  QVERIFY2(timer.elapsed() < 5000, qPrintable(QString::number(timer.elapsed())));
}

VOLUMEN_TEST(TestMorphology);
#include "tst_morphology.moc"
