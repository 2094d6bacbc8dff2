// Guards holes: voxels that a flood fill from the border does not reach, in space and slice by slice.
#include <tbb/global_control.h>

#include "tests/fixtures/seeds.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/suite.h"
#include "viewer/segment/holes.h"

using namespace volumen;
using namespace volumen::tests;

class TestHoles : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatAFloodDoesNotReachIsFilled();
  void aHoleThatOpensAtACornerIsOne();
  void aTubeIsFilledAcrossItAlone();
  void noneAndAllStay_data();
  void noneAndAllStay();
  void sameForAnyNumberOfThreads();
  void cancelledStaysAsItWas();
};

void TestHoles::whatAFloodDoesNotReachIsFilled() {
  const Seeds seeds = seedsOf(1500, 60000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    VoxelGeometry grid = anyGrid(random, random() % 2 ? glm::ivec3(70, 9, 7) : glm::ivec3(9, 140, 6));
    const BitMask mask = anyMask(random, grid);
    const std::string told = caseOf(seed, mask);
    QVERIFY2(holesFilled(mask) == filledSlowly(mask, -1), told.c_str());
    for (int axis = 0; axis < 3; ++axis)
      QVERIFY2(holesFilledInSlices(mask, axis) == filledSlowly(mask, axis), told.c_str());
  }
}

void TestHoles::aHoleThatOpensAtACornerIsOne() {
  // A ring lacks its corners, so that inside and outside touch only at edges.
  BitMask mask({.size = {70, 5, 1}});
  for (int n = -1; n <= 1; ++n)
    for (const glm::ivec3 v : {glm::ivec3(64 + n, 0, 0), {64 + n, 4, 0}, {62, 2 + n, 0}, {66, 2 + n, 0}})
      mask.set(v);
  QCOMPARE(mask.count(), std::int64_t(12));
  QCOMPARE(holesFilledInSlices(mask, 2).count(), std::int64_t(21));
}

void TestHoles::aTubeIsFilledAcrossItAlone() {
  for (int axis = 0; axis < 3; ++axis) {
    glm::ivec3 size(80);
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    size[a] = size[b] = 9;
    BitMask tube({.size = size}), full({.size = size});
    for (const glm::ivec3 v : voxelsOf(tube.geometry())) {
      const int from = std::max(std::abs(v[a] - 4), std::abs(v[b] - 4));
      tube.set(v, from == 2);
      full.set(v, from <= 2);
    }
    QVERIFY(holesFilled(tube) == tube);
    QVERIFY(holesFilledInSlices(tube, axis) == full);
    QVERIFY(holesFilledInSlices(tube, a) == tube);
    QVERIFY(holesFilledInSlices(tube, b) == tube);
  }
}

void TestHoles::noneAndAllStay_data() {
  QTest::addColumn<int>("x");
  QTest::addColumn<int>("y");
  QTest::addColumn<int>("z");
  QTest::newRow("one voxel") << 1 << 1 << 1;
  QTest::newRow("a row") << 70 << 1 << 1;
  QTest::newRow("a slice") << 70 << 66 << 1;
  QTest::newRow("a line across the slices") << 1 << 1 << 9;
  QTest::newRow("a box") << 65 << 3 << 3;
}

void TestHoles::noneAndAllStay() {
  QFETCH(int, x);
  QFETCH(int, y);
  QFETCH(int, z);
  const BitMask none({.size = {x, y, z}}), all = inverted(none);
  for (const BitMask& mask : {none, all}) {
    QVERIFY(holesFilled(mask) == mask);
    for (int axis = 0; axis < 3; ++axis) QVERIFY(holesFilledInSlices(mask, axis) == mask);
  }
}

void TestHoles::sameForAnyNumberOfThreads() {
  std::mt19937 random(6);
  BitMask mask({.size = {130, 90, 70}});
  for (const glm::ivec3 v : voxelsOf(mask.geometry())) mask.set(v, random() % 100 < 70);
  const auto all = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return std::tuple(holesFilled(mask), holesFilledInSlices(mask, 0), holesFilledInSlices(mask, 2));
  };
  const auto one = all(1);
  QVERIFY(std::get<0>(one) != mask);
  QVERIFY(one == all(2));
  QVERIFY(one == all(7));
}

void TestHoles::cancelledStaysAsItWas() {
  const CancelToken cancel;
  cancel.cancel();
  BitMask mask({.size = {5, 5, 5}});
  for (const glm::ivec3 v : voxelsOf(mask.geometry())) mask.set(v, v != glm::ivec3(2));
  QCOMPARE(holesFilled(mask).count(), std::int64_t(125));
  QVERIFY(holesFilled(mask, cancel) == mask);
  for (int axis = 0; axis < 3; ++axis) QVERIFY(holesFilledInSlices(mask, axis, cancel) == mask);
}

VOLUMEN_TEST(TestHoles);
#include "tst_holes.moc"
