// Guards LabelMap: after any edits, shared bricks equal dense labels.
#include <random>

#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "viewer/segment/label_map.h"

using namespace volumen;
using namespace volumen::tests;

class TestLabelMap : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void denseLabelsComeBack_data();
  void denseLabelsComeBack();
  void editsAreThoseOfATwin();
  void whatIsNotWrittenIsShared();
  void bricksOfOneLabelHoldNothing();
  void whatHoldsTheSameIsThatOfEveryVoxel_data() { denseLabelsComeBack_data(); }
  void whatHoldsTheSameIsThatOfEveryVoxel();
};

namespace {

// Returns blobs and noise: bricks of one label, of two and of many.
DenseLabels randomLabels(glm::ivec3 size, std::mt19937& bits) {
  DenseLabels all{{.size = size}, std::vector<std::uint8_t>(std::size_t(size.x) * size.y * size.z)};
  const int from = int(bits() % unsigned(size.x)) / 2;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const bool inBlock = i > from && j > size.y / 3;
        all.labels[std::size_t(i + size.x * (j + size.y * k))] = inBlock     ? 3
                                                                 : i + j < 6 ? std::uint8_t(bits() % 5)
                                                                             : 0;
      }
  return all;
}

}  // namespace

void TestLabelMap::denseLabelsComeBack_data() {
  QTest::addColumn<int>("x");
  QTest::addColumn<int>("y");
  QTest::addColumn<int>("z");
  QTest::newRow("one voxel") << 1 << 1 << 1;
  QTest::newRow("one slice") << 40 << 33 << 1;
  QTest::newRow("one brick") << 32 << 32 << 32;
  QTest::newRow("a voxel more than a brick") << 33 << 33 << 33;
  QTest::newRow("several bricks, none full") << 97 << 70 << 45;
}

void TestLabelMap::denseLabelsComeBack() {
  QFETCH(int, x);
  QFETCH(int, y);
  QFETCH(int, z);
  std::mt19937 bits(17);
  const DenseLabels dense = randomLabels({x, y, z}, bits);
  const LabelMap map(dense);
  QVERIFY(map.geometry() == dense.geometry);
  QVERIFY(map.dense().labels == dense.labels);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(x));
  for (int k = 0; k < z; ++k)
    for (int j = 0; j < y; ++j) {
      map.readRow(j, k, row.data());
      for (int i = 0; i < x; ++i) {
        const std::uint8_t expected = dense.labels[std::size_t(i + x * (j + y * k))];
        QCOMPARE(map.at({i, j, k}), expected);
        QCOMPARE(row[std::size_t(i)], expected);
      }
    }
}

// Applies random strokes to random maps. Older copies of a map must not change.
void TestLabelMap::editsAreThoseOfATwin() {
  const Seeds seeds = seedsOf(60, 2000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    std::mt19937 bits{unsigned(seed)};
    const glm::ivec3 size(1 + int(bits() % 70), 1 + int(bits() % 70), 1 + int(bits() % 40));
    DenseLabels twin = randomLabels(size, bits);
    LabelMap map(twin);
    for (int stroke = 0; stroke < 4; ++stroke) {
      const LabelMap before = map;
      const DenseLabels twinBefore = twin;
      LabelEdit edit(map);
      const auto label = std::uint8_t(bits() % 4);
      const glm::uvec3 low(bits() % unsigned(size.x), bits() % unsigned(size.y), bits() % unsigned(size.z));
      for (int k = int(low.z); k < size.z; ++k)
        for (int j = int(low.y); j < size.y; ++j)
          for (int i = int(low.x); i < size.x; ++i) {
            edit.set({i, j, k}, label);
            twin.labels[std::size_t(i + size.x * (j + size.y * k))] = label;
            if (edit.at({i, j, k}) != label) QFAIL("what was set is not there");
          }
      map = edit.done();
      QVERIFY2(map.dense().labels == twin.labels, qPrintable(QString::number(seed)));
      QVERIFY(map == LabelMap(twin));
      QVERIFY(before.dense().labels == twinBefore.labels);
    }
  }
}

void TestLabelMap::whatIsNotWrittenIsShared() {
  std::mt19937 bits(3);
  const LabelMap map(randomLabels({97, 70, 45}, bits));
  LabelEdit edit(map);
  edit.set({70, 40, 40}, 9);
  const LabelMap after = edit.done();
  QVERIFY(after != map);
  int written = 0;
  for (std::size_t n = 0; n < std::size_t(map.bricks().x) * map.bricks().y * map.bricks().z; ++n)
    written += after.brick(n).voxels != map.brick(n).voxels || after.brick(n).label != map.brick(n).label;
  QCOMPARE(written, 1);
  LabelEdit back(after);
  back.set({70, 40, 40}, map.at({70, 40, 40}));
  QVERIFY(back.done() == map);
}

void TestLabelMap::bricksOfOneLabelHoldNothing() {
  const VoxelGeometry grid{.size = {40, 40, 40}};
  LabelMap map(grid);
  QCOMPARE(map.bytes(), std::size_t(0));
  LabelEdit all(map);
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) all.set({i, j, k}, 2);
  map = all.done();
  QCOMPARE(map.bytes(), std::size_t(0));
  QCOMPARE(map.at({39, 39, 39}), std::uint8_t(2));
  LabelEdit one(map);
  one.set({5, 5, 5}, 0);
  QCOMPARE(one.done().bytes(), sizeof(LabelMap::Voxels));
}

// Compares maps that share bricks, that have separate bricks with equal voxels, and that differ in one voxel.
void TestLabelMap::whatHoldsTheSameIsThatOfEveryVoxel() {
  QFETCH(int, x);
  QFETCH(int, y);
  QFETCH(int, z);
  std::mt19937 bits(29);
  const DenseLabels dense = randomLabels({x, y, z}, bits);
  const LabelMap map(dense), twin(dense);
  for (int label = 0; label < 5; ++label) {
    QVERIFY(holdSame(map, map, std::uint8_t(label)));
    QVERIFY(holdSame(map, twin, std::uint8_t(label)));
  }
  for (int n = 0; n < 20; ++n) {
    const glm::ivec3 at(int(bits() % unsigned(x)), int(bits() % unsigned(y)), int(bits() % unsigned(z)));
    const auto before = map.at(at), after = std::uint8_t((before + 1 + bits() % 4) % 5);
    LabelEdit edit(n % 2 ? map : twin);
    edit.set(at, after);
    const LabelMap changed = edit.done();
    for (int label = 0; label < 5; ++label) {
      const bool isSame = label != before && label != after;
      QCOMPARE(holdSame(map, changed, std::uint8_t(label)), isSame);
      QCOMPARE(holdSame(changed, map, std::uint8_t(label)), isSame);
    }
  }
  DenseLabels moved = dense;
  moved.geometry.origin.x += 1;
  QVERIFY(!holdSame(map, LabelMap(moved), 3));
}

VOLUMEN_TEST(TestLabelMap);
#include "tst_label_map.moc"
