// Guards added_labels.h against a voxel-by-voxel implementation. Bricks without added voxels stay shared.
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "viewer/segment/added_labels.h"

using namespace volumen;
using namespace volumen::tests;

class TestAddedLabels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void eachVoxelIsTheOneThatWasThereBefore();
  void whatIsNotTouchedIsShared();
};

void TestAddedLabels::eachVoxelIsTheOneThatWasThereBefore() {
  const Seeds seeds = seedsOf(200, 4000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    VoxelGeometry grid;
    grid.size = {1 + chance.below(70), 1 + chance.below(40), 1 + chance.below(9)};
    const auto random = [&](int labels) {
      const double share = chance.share();
      DenseLabels dense{grid, std::vector<std::uint8_t>(std::size_t(grid.voxelCount()))};
      for (std::uint8_t& label : dense.labels)
        if (chance.share() < share) label = std::uint8_t(chance.below(labels + 1));
      return dense;
    };
    const DenseLabels before = random(5), other = random(chance.oneIn(5) ? 255 : 4);
    std::array<std::uint8_t, 256> numbers{};
    for (std::size_t n = 1; n < numbers.size(); ++n)
      numbers[n] = std::uint8_t(chance.oneIn(4) ? 0 : 1 + chance.below(255));
    const LabelMap map(before), second(other), added = withLabelsAdded(map, second, numbers);
    DenseLabels twin = before;
    std::bitset<256> overlapping;
    for (std::size_t n = 0; n < twin.labels.size(); ++n) {
      const std::uint8_t label = other.labels[n];
      if (label != 0 && before.labels[n] != 0) overlapping.set(label);
      if (label != 0 && before.labels[n] == 0) twin.labels[n] = numbers[label];
    }
    const QByteArray where = "seed " + QByteArray::number(seed);
    QVERIFY2(added == LabelMap(twin), where);
    QVERIFY2(labelsOverlapping(map, second) == overlapping, where);
  }
}

void TestAddedLabels::whatIsNotTouchedIsShared() {
  VoxelGeometry grid;
  grid.size = {96, 40, 40};
  LabelEdit first{LabelMap(grid)}, second{LabelMap(grid)};
  first.set({1, 1, 1}, 3);
  first.set({90, 1, 1}, 3);
  second.set({2, 1, 1}, 1);
  second.set({90, 1, 1}, 1);
  const LabelMap before = first.done();
  std::array<std::uint8_t, 256> numbers{};
  numbers[1] = 7;
  const LabelMap added = withLabelsAdded(before, second.done(), numbers);
  QCOMPARE(int(added.at({2, 1, 1})), 7);
  QCOMPARE(int(added.at({90, 1, 1})), 3);
  QVERIFY(added.brick(0).voxels != before.brick(0).voxels);
  QVERIFY(before.brick(2).voxels && added.brick(2).voxels == before.brick(2).voxels);
}

VOLUMEN_TEST(TestAddedLabels);
#include "tst_added_labels.moc"
