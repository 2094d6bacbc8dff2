// Guards transfers between maps of segments of one series. Added segments lose no voxel and are put into the
// first map where they fit, in random cases against an independent implementation. Also covers copies and
// moves.
#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "tests/unit/workspace/scanned_maps.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

std::vector<std::size_t> voxelsOf(const LabelMap& labels, int number) {
  std::vector<std::size_t> voxels;
  const glm::ivec3 size = labels.geometry().size;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i)
        if (labels.at({i, j, k}) == number)
          voxels.push_back((std::size_t(k) * std::size_t(size.y) + std::size_t(j)) * std::size_t(size.x) +
                           std::size_t(i));
  return voxels;
}

bool shareVoxels(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
  return std::ranges::any_of(a, [&](std::size_t n) { return std::ranges::binary_search(b, n); });
}

// Returns some labels, any of which may have no voxels.
Segmented layerByChance(Chance& chance, const VoxelGeometry& grid) {
  Segmented layer{{}, LabelMap(grid)};
  LabelEdit edit(layer.labels);
  for (int number = 1 + chance.below(3); number < 9; number += 1 + chance.below(4)) {
    layer.segments.push_back({.number = number, .label = "S" + std::to_string(chance.below(4))});
    for (int voxels = chance.below(12); voxels > 0; --voxels)
      edit.set({chance.below(grid.size.x), chance.below(grid.size.y), chance.below(grid.size.z)},
               std::uint8_t(number));
  }
  layer.labels = edit.done();
  return layer;
}

}  // namespace

class TestBetweenMaps : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsAddedFitsWhereItIs_data();
  void whatIsAddedFitsWhereItIs();
  void moreThan255GoToAFurtherMap();
  void aCopyIsInAnotherMap_data();
  void aCopyIsInAnotherMap();
  void whatIsMovedTakesItsVoxels_data();
  void whatIsMovedTakesItsVoxels();
};

void TestBetweenMaps::whatIsAddedFitsWhereItIs_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(100, 2000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

// Adds layers one after another. Existing segments must not change, and all added ones must have their
// voxels. Each is in the first map whose earlier segments it does not overlap.
void TestBetweenMaps::whatIsAddedFitsWhereItIs() {
  QFETCH(int, seed);
  Chance chance{std::uint64_t(seed)};
  const VoxelGeometry grid = gridOfMaps({1 + chance.below(9), 1 + chance.below(5), 1 + chance.below(4)});
  std::vector<SegmentMap> maps{withoutSegments(grid, chance.below(3))};
  for (int layers = 1 + chance.below(5); layers > 0; --layers) {
    const std::vector<SegmentMap> before = maps;
    const Segmented layer = layerByChance(chance, grid);
    const AddedSegments added = withSegmentsAdded(maps, {&layer, 1});
    maps = added.maps;
    QCOMPARE(added.places.size(), layer.segments.size());
    for (std::size_t n = 0; n < before.size(); ++n)
      for (const Segment& segment : before[n].segments)
        QVERIFY(voxelsOf(*maps[n].labels, segment.number) == voxelsOf(*before[n].labels, segment.number));
    std::vector<SegmentPlace> places = added.places;
    for (const Segment& segment : layer.segments) {
      const std::vector<std::size_t> wanted = voxelsOf(layer.labels, segment.number);
      std::size_t fits = 0;
      const auto taken = [&](std::size_t n) {
        return std::ranges::any_of(before[n].segments, [&](const Segment& there) {
          return shareVoxels(wanted, voxelsOf(*before[n].labels, there.number));
        });
      };
      while (fits < before.size() && taken(fits)) ++fits;
      const auto is = [&](const SegmentPlace& place) {
        return place.map == fits && voxelsOf(*maps[place.map].labels, place.number) == wanted;
      };
      const auto found = std::ranges::find_if(places, is);
      QVERIFY2(found != places.end(), segment.label.c_str());
      places.erase(found);
    }
    std::set<std::string> names;
    std::set<int> numbers;
    for (const SegmentMap& map : maps) {
      QVERIFY(numbers.insert(map.number).second);
      for (const Segment& segment : map.segments) QVERIFY(names.insert(segment.label).second);
    }
  }
}

void TestBetweenMaps::moreThan255GoToAFurtherMap() {
  const VoxelGeometry grid = gridOfMaps({4, 4, 4});
  std::vector<SegmentMap> maps{withoutSegments(grid)};
  Segmented layer{{}, LabelMap(grid)};
  for (int n = 1; n <= 200; ++n) layer.segments.push_back({.number = n, .label = "A" + std::to_string(n)});
  for (int layers = 0; layers < 2; ++layers) maps = withSegmentsAdded(maps, {&layer, 1}).maps;
  QCOMPARE(maps.size(), std::size_t(2));
  QCOMPARE(maps[0].segments.size(), std::size_t(255));
  QCOMPARE(maps[1].segments.size(), std::size_t(145));
}

void TestBetweenMaps::aCopyIsInAnotherMap_data() {
  QTest::addColumn<int>("maps");
  QTest::addColumn<bool>("taken");
  QTest::addColumn<int>("expected");
  QTest::newRow("into a new one") << 1 << false << 1;
  QTest::newRow("into the one that is there") << 2 << false << 1;
  QTest::newRow("past one that has its voxels") << 2 << true << 2;
}

void TestBetweenMaps::aCopyIsInAnotherMap() {
  QFETCH(int, maps);
  QFETCH(bool, taken);
  QFETCH(int, expected);
  const VoxelGeometry grid = gridOfMaps({4, 4, 4});
  BitMask mask(grid);
  mask.set({1, 2, 3});
  Segment bone{.number = 3, .label = "Bone"};
  bone.locked = true;
  bone.trackingId = "1.2.3";
  std::vector<SegmentMap> all{
      withMask(withSegment(withoutSegments(grid), {.number = 3, .label = "Bone"}), 3, mask)};
  all.front().segments.front() = bone;
  if (maps == 2) {
    const Segment other{.number = 1, .label = "Other"};
    all.push_back(withMask(withSegment(withoutSegments(grid, 1), other), 1, taken ? mask : BitMask(grid)));
  }
  const std::vector<SegmentMap> copied = withSegmentCopied(all, 0, 3);
  QCOMPARE(copied.size(), std::size_t(expected + 1));
  QCOMPARE(copied.front().number, expected);
  const Segment copy = *currentSegment(copied.front());
  QCOMPARE(copy.label, std::string("Bone (2)"));
  QVERIFY(copy.colour && *copy.colour != colourOfNumber(3) && !copy.locked && copy.trackingId.empty());
  QVERIFY(maskOf(*copied.front().labels, std::uint8_t(copy.number)) == mask);
  const auto source = std::ranges::find(copied, 0, &SegmentMap::number);
  QVERIFY(*source == all.front());
  QVERIFY(withSegmentCopied(all, 0, 9) == all && withSegmentCopied(all, 5, 3) == all);
}

void TestBetweenMaps::whatIsMovedTakesItsVoxels_data() {
  QTest::addColumn<int>("seed");
  const Seeds seeds = seedsOf(200, 3000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

// Moves a segment from map 2 into map 0, or into the new map 1. It is not moved if a locked segment has a
// common voxel.
void TestBetweenMaps::whatIsMovedTakesItsVoxels() {
  QFETCH(int, seed);
  Chance chance{std::uint64_t(seed)};
  const VoxelGeometry grid = gridOfMaps({1 + chance.below(9), 1 + chance.below(5), 1 + chance.below(4)});
  std::vector<SegmentMap> maps;
  for (const int number : {2, 0}) {
    SegmentMap map = withoutSegments(grid, number);
    const Segmented layer = layerByChance(chance, grid);
    for (const Segment& segment : layer.segments) map = withSegment(std::move(map), segment);
    for (Segment& segment : map.segments) segment.locked = chance.oneIn(4);
    map.labels = std::make_shared<const LabelMap>(layer.labels);
    maps.push_back(std::move(map));
  }
  const Segment segment = maps[0].segments[std::size_t(chance.below(int(maps[0].segments.size())))];
  const bool isNew = chance.oneIn(3);
  const SegmentMap target = isNew ? withoutSegments(grid, 1) : maps[1];
  const std::vector<std::size_t> voxels = voxelsOf(*maps[0].labels, segment.number);
  bool isKept = segment.locked;
  std::map<int, std::vector<std::size_t>> left;
  std::size_t taken = 0;
  for (const Segment& other : target.segments) {
    const std::vector<std::size_t> had = voxelsOf(*target.labels, other.number);
    std::vector<std::size_t>& has = left[other.number];
    std::ranges::set_difference(had, voxels, std::back_inserter(has));
    isKept |= other.locked && has != had;
    taken += had.size() - has.size();
  }
  const std::optional<int> to = isNew ? std::optional<int>() : 0;
  const auto moved = withSegmentMoved(maps, 2, segment.number, to);
  QCOMPARE(moved.ok(), !isKept);
  QVERIFY(!withSegmentMoved(maps, 2, 99, to) && !withSegmentMoved(maps, 7, segment.number, to));
  if (!moved) return;
  QCOMPARE(moved->taken, std::int64_t(taken));
  const SegmentMap& after = moved->maps.front();
  QCOMPARE(after.number, target.number);
  const Segment there = *currentSegment(after);
  QVERIFY(there.number == segment.number || findSegment(target, segment.number));
  QVERIFY(there.label.starts_with(segment.label));
  Segment expected = segment;
  expected.number = there.number, expected.label = there.label;
  QVERIFY(there == expected);
  QVERIFY(voxelsOf(*after.labels, there.number) == voxels);
  for (const Segment& other : target.segments) {
    QVERIFY(*findSegment(after, other.number) == other);
    QVERIFY(voxelsOf(*after.labels, other.number) == left[other.number]);
  }
  const SegmentMap source = *std::ranges::find(moved->maps, 2, &SegmentMap::number);
  QVERIFY(!findSegment(source, segment.number) && voxelsOf(*source.labels, segment.number).empty());
  QCOMPARE(source.segments.size() + 1, maps[0].segments.size());
  for (const Segment& other : source.segments)
    QVERIFY(voxelsOf(*source.labels, other.number) == voxelsOf(*maps[0].labels, other.number));
}

VOLUMEN_TEST(TestBetweenMaps);
#include "tst_between_maps.moc"
