// Guards bit masks: the same voxels as sets of voxels, on rows of any length, and conversion into label maps
// and back.
#include <tbb/global_control.h>

#include <set>

#include "tests/fixtures/seeds.h"
#include "tests/unit/segment/bit_masks.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

class TestBitMask : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void voxelsAreSetAndCounted_data();
  void voxelsAreSetAndCounted();
  void setsAreCombinedVoxelByVoxel();
  void theBoxIsTheSmallest();
  void aLabelComesBack();
  void onlyTheLabelsVoxelsChange();
  void bricksThatStayAreShared();
  void lockedLabelsStay_data();
  void lockedLabelsStay();
  void sameForAnyNumberOfThreads();
};

namespace {

LabelMap anyLabels(std::mt19937& random, const VoxelGeometry& grid) {
  DenseLabels dense{grid, std::vector<std::uint8_t>(std::size_t(grid.voxelCount()))};
  const bool blocks = random() % 2 == 0;
  for (std::size_t n = 0; n < dense.labels.size(); ++n)
    dense.labels[n] = std::uint8_t(blocks ? n / (1 + dense.labels.size() / 3) : random() % 5);
  return LabelMap(dense);
}

// Returns a grid of up to 100 x 40 x 40 voxels, so that there are several bricks.
VoxelGeometry gridOfBricks(std::mt19937& random) { return anyGrid(random, {100, 40, 40}); }

}  // namespace

void TestBitMask::voxelsAreSetAndCounted_data() {
  QTest::addColumn<int>("x");
  for (const int x : {1, 2, 63, 64, 65, 127, 128, 129}) QTest::addRow("rows of %d", x) << x;
}

void TestBitMask::voxelsAreSetAndCounted() {
  QFETCH(int, x);
  BitMask mask({.size = {x, 3, 2}});
  QVERIFY(mask.empty());
  QCOMPARE(mask.count(), std::int64_t(0));
  QVERIFY(!mask.box());
  mask.set({x - 1, 2, 1});
  mask.set({0, 1, 0});
  QVERIFY(isExactly(mask,
                    [&](glm::ivec3 v) { return v == glm::ivec3(x - 1, 2, 1) || v == glm::ivec3(0, 1, 0); }));
  QVERIFY(mask.at({x - 1, 2, 1}) && mask.at({0, 1, 0}) && !mask.at({0, 0, 0}));
  QCOMPARE(mask.count(), std::int64_t(2));
  mask.set({0, 1, 0}, false);
  QCOMPARE(mask.count(), std::int64_t(1));
  QVERIFY(!mask.empty());
  const BitMask all = inverted(BitMask(mask.geometry()));
  QCOMPARE(all.count(), std::int64_t(x) * 6);
  QVERIFY(isExactly(all, [](glm::ivec3) { return true; }));
  QVERIFY(inverted(all).empty());
}

void TestBitMask::setsAreCombinedVoxelByVoxel() {
  const Seeds seeds = seedsOf(400, 20000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const VoxelGeometry grid = anyGrid(random, {140, 6, 5});
    const BitMask a = anyMask(random, grid), b = anyMask(random, grid);
    const std::string told = caseOf(seed, a);
    QVERIFY2(isExactly(united(a, b), [&](glm::ivec3 v) { return a.at(v) || b.at(v); }), told.c_str());
    QVERIFY2(isExactly(intersected(a, b), [&](glm::ivec3 v) { return a.at(v) && b.at(v); }), told.c_str());
    QVERIFY2(isExactly(subtracted(a, b), [&](glm::ivec3 v) { return a.at(v) && !b.at(v); }), told.c_str());
    QVERIFY2(isExactly(inverted(a), [&](glm::ivec3 v) { return !a.at(v); }), told.c_str());
    std::int64_t count = 0;
    for (const glm::ivec3 v : voxelsOf(grid)) count += a.at(v);
    QCOMPARE(a.count(), count);
    QCOMPARE(a.empty(), count == 0);
  }
}

void TestBitMask::theBoxIsTheSmallest() {
  const Seeds seeds = seedsOf(400, 20000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    BitMask mask(anyGrid(random, {140, 6, 5}));
    const auto voxels = voxelsOf(mask.geometry());
    std::optional<VoxelBox> expected;
    for (int n = int(random() % 4); n > 0; --n) {
      const glm::ivec3 v = voxels[random() % voxels.size()];
      mask.set(v);
      if (!expected) expected = {v, v};
      expected->low = glm::min(expected->low, v), expected->high = glm::max(expected->high, v);
    }
    QVERIFY2(mask.box() == expected, caseOf(seed, mask).c_str());
  }
}

void TestBitMask::aLabelComesBack() {
  const Seeds seeds = seedsOf(100, 4000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const VoxelGeometry grid = gridOfBricks(random);
    const LabelMap map = anyLabels(random, grid);
    const BitMask mask = anyMask(random, grid);
    for (const std::uint8_t label : {0, 1, 4, 255})
      QVERIFY2(isExactly(maskOf(map, label), [&](glm::ivec3 v) { return map.at(v) == label; }),
               caseOf(seed, mask).c_str());
    QVERIFY2(maskOf(withLabel(map, 200, mask), 200) == mask, caseOf(seed, mask).c_str());
    QVERIFY2(maskOf(withLabel(map, 1, mask), 1) == mask, caseOf(seed, mask).c_str());
  }
}

// Compares with the definition. The bricks must equal those of a dense map, and locked labels must not
// change.
void TestBitMask::onlyTheLabelsVoxelsChange() {
  const Seeds seeds = seedsOf(100, 4000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 random{unsigned(seed)};
    const VoxelGeometry grid = gridOfBricks(random);
    const LabelMap map = anyLabels(random, grid);
    const BitMask mask = anyMask(random, grid);
    std::vector<std::uint8_t> locked;
    for (int n = int(random() % 3); n > 0; --n) locked.push_back(std::uint8_t(random() % 5));
    const auto label = std::uint8_t(random() % 4);
    const LabelMap made = withLabel(map, label, mask, locked);
    DenseLabels twin = map.dense();
    std::size_t n = 0;
    for (const glm::ivec3 v : voxelsOf(grid)) {
      std::uint8_t& at = twin.labels[n++];
      if (std::ranges::find(locked, at) == locked.end()) at = mask.at(v) ? label : at == label ? 0 : at;
    }
    QVERIFY2(made == LabelMap(twin), caseOf(seed, mask).c_str());
    QVERIFY2(made.bytes() == LabelMap(twin).bytes(), caseOf(seed, mask).c_str());
  }
}

void TestBitMask::bricksThatStayAreShared() {
  std::mt19937 random(3);
  const VoxelGeometry grid{.size = {97, 70, 45}};
  const LabelMap map = anyLabels(random, grid);
  BitMask mask = maskOf(map, 2);
  const auto different = [&](const LabelMap& other) {
    int count = 0;
    for (std::size_t n = 0; n < std::size_t(map.bricks().x) * map.bricks().y * map.bricks().z; ++n)
      count += other.brick(n).voxels != map.brick(n).voxels || other.brick(n).label != map.brick(n).label;
    return count;
  };
  QCOMPARE(different(withLabel(map, 2, mask)), 0);
  mask.set({70, 40, 40}, !mask.at({70, 40, 40}));
  QCOMPARE(different(withLabel(map, 2, mask)), 1);
  const std::uint8_t all[] = {0, 1, 2, 3, 4};
  QCOMPARE(different(withLabel(map, 2, mask, all)), 0);
}

void TestBitMask::lockedLabelsStay_data() {
  QTest::addColumn<std::vector<std::uint8_t>>("locked");
  QTest::addColumn<std::vector<std::uint8_t>>(
      "expected");  // for voxels 0 1 2 2 0 1 2, of which the mask holds the first three
  using Labels = std::vector<std::uint8_t>;
  QTest::newRow("none") << Labels{} << Labels{2, 2, 2, 0, 0, 1, 0};
  QTest::newRow("another label") << Labels{1} << Labels{2, 1, 2, 0, 0, 1, 0};
  QTest::newRow("background") << Labels{0} << Labels{0, 2, 2, 0, 0, 1, 0};
  QTest::newRow("the label itself") << Labels{2} << Labels{2, 2, 2, 2, 0, 1, 2};
}

void TestBitMask::lockedLabelsStay() {
  QFETCH(std::vector<std::uint8_t>, locked);
  QFETCH(std::vector<std::uint8_t>, expected);
  const VoxelGeometry grid{.size = {7, 1, 1}};
  const LabelMap map(DenseLabels{grid, {0, 1, 2, 2, 0, 1, 2}});
  BitMask mask(grid);
  for (int i = 0; i < 3; ++i) mask.set({i, 0, 0});
  QCOMPARE(withLabel(map, 2, mask, locked).dense().labels, expected);
}

void TestBitMask::sameForAnyNumberOfThreads() {
  std::mt19937 random(11);
  const VoxelGeometry grid{.size = {130, 60, 50}};
  const LabelMap map = anyLabels(random, grid);
  const BitMask a = anyMask(random, grid), b = anyMask(random, grid);
  const auto all = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return std::tuple(united(a, b), inverted(a), a.count(), maskOf(map, 1),
                      withLabel(map, 3, b).dense().labels);
  };
  QVERIFY(all(1) == all(2));
  QVERIFY(all(1) == all(7));
}

VOLUMEN_TEST(TestBitMask);
#include "tst_bit_mask.moc"
