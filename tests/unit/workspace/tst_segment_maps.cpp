// Guards several maps of segments of one series: each is changed alone, one of them is worked on; what is
// added loses no voxel and is in the first map where it fits, by chance against a twin; copies, moves, names
// and colours; closed series come back with all of their maps.
#include <iterator>
#include <map>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/unit/suite.h"
#include "ui/workspace/segment_maps.h"
#include "ui/workspace/segments.h"

using namespace volumen;
using volumen::tests::Chance;

namespace {

VoxelGeometry gridOfMaps(glm::ivec3 size) {
  VoxelGeometry grid;
  grid.size = size;
  return grid;
}

Series scannedSeries() {
  Series series;
  series.path = "/data/ct";
  series.id = "1";
  return series;
}

const SeriesKey scanKey = keyOf(scannedSeries());

SegmentMap withoutSegments(const VoxelGeometry& grid, int number = 0) {
  SegmentMap map{scanKey, {}, std::make_shared<const LabelMap>(grid), {}};
  map.number = number;
  return map;
}

Workspace withScannedSeries() {
  Workspace workspace;
  workspace.series.editOrAdd(scanKey).series = std::make_shared<const Series>(scannedSeries());
  return workspace;
}

// Two maps with a segment each, the first worked on.
Workspace withTwoMaps() {
  const VoxelGeometry grid = gridOfMaps({4, 4, 4});
  Workspace w = withNewSegment(withScannedSeries(), scanKey, grid, {});
  return withNewSegment(std::move(w), scanKey, grid, {}, 1);
}

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

// Some labels, each of which may have no voxel.
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

class TestSegmentMaps : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void oneIsWorkedOn();
  void eachIsChangedAlone();
  void lookIsThatOfAll();
  void anotherGridTakesThePlaceOfAll();
  void namesAndColoursAreApart();
  void namesAreCounted_data();
  void namesAreCounted();
  void coloursThatAreTakenBecomeOthers();
  void newColoursAreFreeInAllMaps();
  void whatIsAddedFitsWhereItIs_data();
  void whatIsAddedFitsWhereItIs();
  void moreThan255GoToAFurtherMap();
  void aCopyIsInAnotherMap_data();
  void aCopyIsInAnotherMap();
  void whatIsMovedTakesItsVoxels_data();
  void whatIsMovedTakesItsVoxels();
  void closedSeriesComeBackWithAll();
};

void TestSegmentMaps::oneIsWorkedOn() {
  const Workspace w = withTwoMaps();
  QCOMPARE(segmentMapOf(w, scanKey)->number, 0);
  const Workspace second = withMapWorkedOn(w, scanKey, 1);
  QCOMPARE(segmentMapOf(second, scanKey)->number, 1);
  QVERIFY(second != w && withMapWorkedOn(second, scanKey, 0) == w);
  QVERIFY(withMapWorkedOn(w, scanKey, 0) == w && withMapWorkedOn(w, scanKey, 7) == w);
  QVERIFY(withMapWorkedOn(w, {"/none", "2"}, 1) == w);
  QVERIFY(segmentMapsOf(second, scanKey).front()->number == 0 && segmentMapsOf(second, scanKey).size() == 2);
  QCOMPARE(segmentMapsOn(second, scanKey, gridOfMaps({4, 4, 4})).front().number, 1);
}

void TestSegmentMaps::eachIsChangedAlone() {
  const Workspace w = withTwoMaps();
  const SegmentMap first = *segmentMapOf(w, scanKey, 0);
  BitMask mask(gridOfMaps({4, 4, 4}));
  mask.set({1, 2, 3});
  Workspace changed = withSegmentMap(w, withMask(*segmentMapOf(w, scanKey, 1), 1, mask));
  QVERIFY(*segmentMapOf(changed, scanKey, 0) == first);
  QVERIFY(maskOf(*segmentMapOf(changed, scanKey, 1)->labels, 1) == mask);
  changed = withSegmentMap(withMapWorkedOn(changed, scanKey, 1),
                           withoutSegment(*segmentMapOf(changed, scanKey, 1), 1));
  QVERIFY2(segmentMapsOf(changed, scanKey).size() == 1, "a map without segments goes");
  QVERIFY2(*segmentMapOf(changed, scanKey) == first, "the one that is left is worked on");
}

void TestSegmentMaps::lookIsThatOfAll() {
  const Workspace w = withTissueShown(withSegmentsIn3d(withTwoMaps(), scanKey, false), scanKey,
                                      {TissueShown::Where::inside, 2});
  for (const SegmentMap* map : segmentMapsOf(w, scanKey))
    QVERIFY(!map->in3d && map->tissue.where == TissueShown::Where::inside);
  const SegmentMap third = segmentMapOn(w, scanKey, gridOfMaps({4, 4, 4}), 2);
  QVERIFY(third.number == 2 && !third.in3d && third.tissue == segmentMapOf(w, scanKey)->tissue);
}

void TestSegmentMaps::anotherGridTakesThePlaceOfAll() {
  const Workspace w = withNewSegment(withTwoMaps(), scanKey, gridOfMaps({5, 4, 4}), {});
  QCOMPARE(w.segmentMaps.size(), std::size_t(1));
  QVERIFY(isOn(*segmentMapOf(w, scanKey), gridOfMaps({5, 4, 4})));
}

void TestSegmentMaps::namesAndColoursAreApart() {
  Workspace w = withTwoMaps();
  const Segment bone{.label = "Bone"};
  for (const int map : {0, 1, 1}) w = withNewSegment(std::move(w), scanKey, gridOfMaps({4, 4, 4}), bone, map);
  std::vector<std::string> names;
  std::vector<glm::u8vec3> colours;
  for (const SegmentMap* map : segmentMapsOf(w, scanKey))
    for (const Segment& segment : map->segments) {
      names.push_back(segment.label);
      QVERIFY(std::ranges::find(colours, *segment.colour) == colours.end());
      colours.push_back(*segment.colour);
    }
  const std::vector<std::string> expected{"Segment 1", "Bone", "Segment 2", "Bone (2)", "Bone (3)"};
  QVERIFY(names == expected);
}

void TestSegmentMaps::namesAreCounted_data() {
  QTest::addColumn<QStringList>("there");
  QTest::addColumn<QString>("wanted");
  QTest::addColumn<QString>("name");
  const auto row = [](const char* what, const QStringList& there, const char* wanted, const char* name) {
    QTest::newRow(what) << there << QString::fromLatin1(wanted) << QString::fromLatin1(name);
  };
  const QString bone = QStringLiteral("Bone"), second = QStringLiteral("Bone (2)");
  row("free", {bone}, "Skin", "Skin");
  row("taken", {bone}, "Bone", "Bone (2)");
  row("with a number", {QStringLiteral("Segment 1")}, "Segment 1", "Segment 1 (2)");
  row("the second, too", {bone, second}, "Bone", "Bone (3)");
  row("of the second", {bone, second}, "Bone (2)", "Bone (3)");
  row("without the first", {second}, "Bone (2)", "Bone (3)");
  row("a year", {QStringLiteral("Bone (2024)")}, "Bone (2024)", "Bone (2024) (2)");
  row("a word", {QStringLiteral("Bone (left)")}, "Bone (left)", "Bone (left) (2)");
  row("nothing in brackets", {QStringLiteral("Bone ()")}, "Bone ()", "Bone () (2)");
}

// In one map, in another one, and in both.
void TestSegmentMaps::namesAreCounted() {
  QFETCH(QStringList, there);
  QFETCH(QString, wanted);
  QFETCH(QString, name);
  const VoxelGeometry grid = gridOfMaps({4, 4, 4});
  for (std::size_t split = 0; split <= std::size_t(there.size()); ++split) {
    std::vector<SegmentMap> maps{withoutSegments(grid), withoutSegments(grid, 1)};
    for (std::size_t n = 0; n < std::size_t(there.size()); ++n) {
      SegmentMap& map = maps[n < split ? 0 : 1];
      map = withSegment(map, {.number = *freeNumber(map), .label = there[qsizetype(n)].toStdString()});
    }
    QCOMPARE(freeName(maps, wanted.toStdString()), name.toStdString());
    const Segmented layer{{{.number = 1, .label = wanted.toStdString()}}, LabelMap(grid)};
    const AddedSegments added = withSegmentsAdded(maps, {&layer, 1});
    const SegmentPlace place = added.places.front();
    QCOMPARE(findSegment(added.maps[place.map], place.number)->label, name.toStdString());
  }
}

// Of those that were there; what is alike in the file stays so.
void TestSegmentMaps::coloursThatAreTakenBecomeOthers() {
  const VoxelGeometry grid = gridOfMaps({4, 4, 4});
  const glm::u8vec3 bone(240, 219, 163), skin(1, 2, 3);
  std::vector<SegmentMap> maps{
      withSegment(withoutSegments(grid), {.number = 1, .label = "Bone", .colour = bone})};
  DenseLabels all{grid, std::vector<std::uint8_t>(64, 1)};
  const std::vector<Segmented> layers{
      {{{.number = 1, .label = "Bone", .colour = bone}}, LabelMap(all)},
      {{{.number = 1, .label = "Skin", .colour = skin}, {.number = 2, .label = "Fat", .colour = skin}},
       LabelMap(all)}};
  const AddedSegments added = withSegmentsAdded(maps, layers);
  const auto colourOf = [&](const std::string& name) {
    for (const SegmentMap& map : added.maps)
      for (const Segment& segment : map.segments)
        if (segment.label == name) return segment.colour;
    return std::optional<glm::u8vec3>();
  };
  QVERIFY(colourOf("Bone") == bone && colourOf("Bone (2)") == colourOfNumber(1));
  QVERIFY(colourOf("Skin") == skin && colourOf("Fat") == skin);
  // A recipe that is followed twice.
  const SegmentMap& before = added.maps.front();
  SegmentMap after = withSegmentAdded(before, {.label = "Bone", .colour = bone});
  after = withNewOnesApart(before, withSegmentAdded(after, {.label = "Marrow", .colour = bone}), added.maps);
  std::vector<glm::u8vec3> colours;
  for (const SegmentMap& map : added.maps)
    for (const Segment& segment : map.segments) colours.push_back(*segment.colour);
  QCOMPARE(after.segments.size(), before.segments.size() + 2);
  for (std::size_t n = before.segments.size(); n < after.segments.size(); ++n) {
    const glm::u8vec3 colour = *after.segments[n].colour;
    QVERIFY2(std::ranges::find(colours, colour) == colours.end(), after.segments[n].label.c_str());
    colours.push_back(colour);
  }
}

// Ten of them, in whichever of three maps; then they begin again.
void TestSegmentMaps::newColoursAreFreeInAllMaps() {
  const VoxelGeometry grid = gridOfMaps({4, 4, 4});
  Workspace w = withScannedSeries();
  std::vector<glm::u8vec3> colours;
  for (int n = 0; n < 10; ++n) {
    const int map = n % 3;
    w = withNewSegment(std::move(w), scanKey, grid, {}, map);
    const glm::u8vec3 colour = *currentSegment(*segmentMapOf(w, scanKey, map))->colour;
    QVERIFY(std::ranges::find(colours, colour) == colours.end());
    colours.push_back(colour);
  }
  w = withNewSegment(std::move(w), scanKey, grid, {}, 0);
  const glm::u8vec3 eleventh = *currentSegment(*segmentMapOf(w, scanKey, 0))->colour;
  QVERIFY(std::ranges::find(colours, eleventh) != colours.end());
}

void TestSegmentMaps::whatIsAddedFitsWhereItIs_data() {
  QTest::addColumn<int>("seed");
  const tests::Seeds seeds = tests::seedsOf(100, 2000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

// Layers one after the other; nothing that is there changes, all that comes has its voxels, and each is in no
// later map than the first whose voxels (of before the layer) it leaves alone.
void TestSegmentMaps::whatIsAddedFitsWhereItIs() {
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

void TestSegmentMaps::moreThan255GoToAFurtherMap() {
  const VoxelGeometry grid = gridOfMaps({4, 4, 4});
  std::vector<SegmentMap> maps{withoutSegments(grid)};
  Segmented layer{{}, LabelMap(grid)};
  for (int n = 1; n <= 200; ++n) layer.segments.push_back({.number = n, .label = "A" + std::to_string(n)});
  for (int layers = 0; layers < 2; ++layers) maps = withSegmentsAdded(maps, {&layer, 1}).maps;
  QCOMPARE(maps.size(), std::size_t(2));
  QCOMPARE(maps[0].segments.size(), std::size_t(255));
  QCOMPARE(maps[1].segments.size(), std::size_t(145));
}

void TestSegmentMaps::aCopyIsInAnotherMap_data() {
  QTest::addColumn<int>("maps");
  QTest::addColumn<bool>("taken");
  QTest::addColumn<int>("expected");
  QTest::newRow("into a new one") << 1 << false << 1;
  QTest::newRow("into the one that is there") << 2 << false << 1;
  QTest::newRow("past one that has its voxels") << 2 << true << 2;
}

void TestSegmentMaps::aCopyIsInAnotherMap() {
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

void TestSegmentMaps::whatIsMovedTakesItsVoxels_data() {
  QTest::addColumn<int>("seed");
  const tests::Seeds seeds = tests::seedsOf(200, 3000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) QTest::addRow("seed %d", seed) << seed;
}

// Out of map 2 into map 0, or a new one, which is 1; nothing is moved where a locked segment has a voxel of
// it.
void TestSegmentMaps::whatIsMovedTakesItsVoxels() {
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

void TestSegmentMaps::closedSeriesComeBackWithAll() {
  const Workspace w = withMapWorkedOn(withTwoMaps(), scanKey, 1);
  const Workspace closed = without(w, scanKey);
  QVERIFY(closed.segmentMaps.empty() && segmentMapsOf(closed, scanKey).empty());
  QVERIFY(withClosed(closed).segmentMaps == w.segmentMaps);
  // Where segments were made meanwhile they are not in each other's way.
  Workspace again = closed;
  again.series.editOrAdd(scanKey).series = std::make_shared<const Series>(scannedSeries());
  again = withClosed(withNewSegment(std::move(again), scanKey, gridOfMaps({4, 4, 4}), {}));
  std::vector<int> numbers;
  for (const SegmentMap* map : segmentMapsOf(again, scanKey)) numbers.push_back(map->number);
  QVERIFY((numbers == std::vector<int>{0, 1, 2}));
  // And they are shown as those, as a session wants it.
  const Workspace flat =
      without(withTissueShown(withSegmentsIn3d(w, scanKey, false), scanKey, {TissueShown::Where::inside, 2}),
              scanKey);
  again = flat;
  again.series.editOrAdd(scanKey).series = std::make_shared<const Series>(scannedSeries());
  again = withClosed(withNewSegment(std::move(again), scanKey, gridOfMaps({4, 4, 4}), {}));
  QCOMPARE(segmentMapsOf(again, scanKey).size(), std::size_t(3));
  for (const SegmentMap* map : segmentMapsOf(again, scanKey))
    QVERIFY(map->in3d && map->tissue == TissueShown{});
}

VOLUMEN_TEST(TestSegmentMaps);
#include "tst_segment_maps.moc"
