// Guards the pure functions of segments in a workspace: free numbers and names, the current segment, locks,
// and sharing of unchanged labels. Random sequences are compared with an array of labels.
#include "results/segments/segments.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "ui/workspace/series_segments.h"

using namespace volumen;
using volumen::tests::Chance;

namespace {

const SeriesKey scanned{"/data/ct", "1"};

VoxelGeometry gridOf(glm::ivec3 size) {
  VoxelGeometry grid;
  grid.size = size;
  return grid;
}

// Returns a workspace with the series.
Workspace withScan() {
  Series series;
  series.path = scanned.path;
  series.id = scanned.id;
  Workspace workspace;
  workspace.series.editOrAdd(keyOf(series)).series = std::make_shared<const Series>(series);
  return workspace;
}

SeriesKey keyIn(const Workspace& workspace) { return workspace.series.begin()->first; }

const SegmentMap& mapIn(const Workspace& workspace) { return workspace.segmentMaps.front(); }

BitMask maskByChance(Chance& chance, const VoxelGeometry& grid) {
  BitMask mask(grid);
  const int parts = 1 + chance.below(6);
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i)
        if (chance.below(8) < parts) mask.set({i, j, k});
  return mask;
}

}  // namespace

class TestSegmentEdits : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void newOnesGetWhatIsFree();
  void anAddedOneKeepsWhatIsFree();
  void thereAreAtMost255();
  void theCurrentOneIsAlwaysThere();
  void whatIsNotThereChangesNothing();
  void anotherGridBeginsAnew();
  void whatDidNotChangeIsShared();
  void sequencesAgreeWithTheTwin_data();
  void sequencesAgreeWithTheTwin();
};

void TestSegmentEdits::newOnesGetWhatIsFree() {
  const VoxelGeometry grid = gridOf({4, 4, 4});
  Workspace w = withScan();
  const SeriesKey key = keyIn(w);
  for (int n = 0; n < 3; ++n) w = withNewSegment(std::move(w), key, grid, {});
  Segment bone;
  bone.label = "Bone";
  bone.colour = glm::u8vec3(1, 2, 3);
  w = withSegmentMap(w, withoutSegment(mapIn(w), 2));
  w = withNewSegment(std::move(w), key, grid, bone);
  w = withNewSegment(std::move(w), key, grid, bone);
  std::vector<std::pair<int, std::string>> seen;
  for (const Segment& s : mapIn(w).segments) seen.emplace_back(s.number, s.label);
  const std::vector<std::pair<int, std::string>> expected{
      {1, "Segment 1"}, {3, "Segment 3"}, {2, "Bone"}, {4, "Bone (2)"}};
  QVERIFY(seen == expected);
  QVERIFY(findSegment(mapIn(w), 2)->colour == bone.colour && findSegment(mapIn(w), 1)->colour);
  QVERIFY(findSegment(mapIn(w), 4)->colour == colourOfNumber(4));
}

void TestSegmentEdits::anAddedOneKeepsWhatIsFree() {
  SegmentMap map{scanned, {}, std::make_shared<const LabelMap>(gridOf({4, 4, 4})), {}};
  const Segment bone{.number = 7, .label = "Bone", .colour = glm::u8vec3(1, 2, 3)};
  map = withSegmentAdded(map, bone);
  QVERIFY(map.current == 7 && map.segments.back() == bone);
  map = withSegmentAdded(map, bone);
  QCOMPARE(map.segments.back().number, 1);
  QCOMPARE(map.segments.back().label, std::string("Bone (2)"));
  QVERIFY(map.segments.back().colour == bone.colour);
  for (const int number : {0, -3, 256}) {
    map = withSegmentAdded(map, {.number = number});
    QVERIFY(map.segments.back().number <= 4 && map.current == map.segments.back().number);
    QVERIFY(!map.segments.back().label.empty() && map.segments.back().colour);
  }
  QCOMPARE(map.segments.size(), std::size_t(5));
}

void TestSegmentEdits::thereAreAtMost255() {
  Workspace w = withScan();
  const SeriesKey key = keyIn(w);
  for (int n = 0; n < 300; ++n) w = withNewSegment(std::move(w), key, gridOf({2, 2, 2}), {});
  QCOMPARE(mapIn(w).segments.size(), std::size_t(255));
  QVERIFY(!freeNumber(mapIn(w)));
  QVERIFY(withNewSegment(w, key, gridOf({2, 2, 2}), {}) == w);
}

void TestSegmentEdits::theCurrentOneIsAlwaysThere() {
  Workspace w = withScan();
  const SeriesKey key = keyIn(w);
  for (int n = 0; n < 3; ++n) w = withNewSegment(std::move(w), key, gridOf({4, 4, 4}), {});
  QCOMPARE(currentSegment(mapIn(w))->number, 3);
  QCOMPARE(currentSegment(withoutSegment(mapIn(w), 3))->number, 2);
  QCOMPARE(currentSegment(withoutSegment(mapIn(w), 1))->number, 2);
  SegmentMap map = mapIn(w);
  map.current = 77;
  QCOMPARE(currentSegment(map)->number, 1);
  for (const int number : {1, 2, 3}) map = withoutSegment(map, number);
  QVERIFY(!currentSegment(map) && map.segments.empty());
  QVERIFY(withSegmentMap(w, map).segmentMaps.empty());
}

void TestSegmentEdits::whatIsNotThereChangesNothing() {
  Workspace w = withScan();
  const SeriesKey key = keyIn(w), none{"/none", "2"};
  w = withNewSegment(std::move(w), key, gridOf({4, 4, 4}), {});
  const auto rename = [](Segment& s) { s.label = "x", s.number = 9; };
  QVERIFY(withSegmentChanged(w, key, 7, rename) == w && withSegmentChanged(w, none, 1, rename) == w);
  QVERIFY(withCurrentSegment(w, key, 7) == w && withCurrentSegment(w, none, 1) == w);
  QVERIFY(withNewSegment(w, none, gridOf({4, 4, 4}), {}) == w);
  QVERIFY(withMask(mapIn(w), 7, BitMask(gridOf({4, 4, 4}))) == mapIn(w));
  QCOMPARE(mapIn(withSegmentChanged(w, key, 1, rename)).segments.front().number, 1);
}

void TestSegmentEdits::anotherGridBeginsAnew() {
  Workspace w = withScan();
  const SeriesKey key = keyIn(w);
  for (int n = 0; n < 2; ++n) w = withNewSegment(std::move(w), key, gridOf({4, 4, 4}), {});
  w = withNewSegment(std::move(w), key, gridOf({5, 4, 4}), {});
  QCOMPARE(w.segmentMaps.size(), std::size_t(1));
  QCOMPARE(mapIn(w).segments.size(), std::size_t(1));
  QVERIFY(isOn(mapIn(w), gridOf({5, 4, 4})));
}

// Changes one voxel of 4 x 4 x 4 bricks of noise.
void TestSegmentEdits::whatDidNotChangeIsShared() {
  Chance chance(3);
  const VoxelGeometry grid = gridOf({128, 128, 128});
  Workspace w = withNewSegment(withScan(), keyIn(withScan()), grid, {});
  const SegmentMap before = withMask(mapIn(w), 1, maskByChance(chance, grid));
  BitMask other = maskOf(*before.labels, 1);
  other.set({70, 3, 100}, !other.at({70, 3, 100}));
  const SegmentMap after = withMask(before, 1, other);
  int own = 0;
  for (std::size_t n = 0; n < 64; ++n)
    own += after.labels->brick(n).voxels != before.labels->brick(n).voxels ? 1 : 0;
  QCOMPARE(own, 1);
}

void TestSegmentEdits::sequencesAgreeWithTheTwin_data() {
  QTest::addColumn<int>("seed");
  const tests::Seeds seeds = tests::seedsOf(20, 200);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

// Compares with an array of labels and the set of locked ones.
void TestSegmentEdits::sequencesAgreeWithTheTwin() {
  QFETCH(int, seed);
  Chance chance{std::uint64_t(seed)};
  const VoxelGeometry grid = gridOf({1 + chance.below(40), 1 + chance.below(12), 1 + chance.below(12)});
  Workspace w = withScan();
  const SeriesKey key = keyIn(w);
  std::vector<int> twin(std::size_t(grid.voxelCount()));
  for (int act = 0; act < 60; ++act) {
    const SegmentMap map = segmentMapOn(w, key, grid);
    const int count = int(map.segments.size());
    const Segment chosen = count ? map.segments[std::size_t(chance.below(count))] : Segment{};
    const int what = count ? chance.below(6) : 0;
    if (what == 0) w = withNewSegment(std::move(w), key, grid, {});
    if (what == 1)
      w = withSegmentChanged(std::move(w), key, chosen.number,
                             [&](Segment& s) { s.locked = chance.oneIn(3); });
    if (what == 2) {
      if (!chosen.locked)
        for (int& label : twin)
          if (label == chosen.number) label = 0;
      w = withSegmentMap(std::move(w), withoutSegment(map, chosen.number));
      if (count == 1 && !chosen.locked) QVERIFY(w.segmentMaps.empty());
    }
    if (what > 2) {
      const BitMask mask = maskByChance(chance, grid);
      for (std::size_t n = 0; n < twin.size(); ++n) {
        const glm::ivec3 size = grid.size;
        const glm::ivec3 voxel(int(n) % size.x, int(n) / size.x % size.y, int(n) / size.x / size.y);
        const Segment* holder = findSegment(map, twin[n]);
        if (chosen.locked || (holder && holder->locked)) continue;
        if (mask.at(voxel))
          twin[n] = chosen.number;
        else if (twin[n] == chosen.number)
          twin[n] = 0;
      }
      w = withSegmentMap(std::move(w), withMask(map, chosen.number, mask));
    }
    const SegmentMap now = segmentMapOn(w, key, grid);
    for (std::size_t n = 0; n < twin.size(); ++n) {
      const glm::ivec3 size = grid.size;
      const glm::ivec3 voxel(int(n) % size.x, int(n) / size.x % size.y, int(n) / size.x / size.y);
      QCOMPARE(int(now.labels->at(voxel)), twin[n]);
    }
  }
}

VOLUMEN_TEST(TestSegmentEdits);
#include "tst_segment_edits.moc"
