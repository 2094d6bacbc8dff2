// Guards several maps of segments of one series: each is edited separately, and one is active. Names and
// colours are distinct, and reopened series restore all maps.
#include <algorithm>

#include "results/segments/segment_maps.h"
#include "results/segments/segments.h"
#include "tests/unit/suite.h"
#include "tests/unit/workspace/scanned_maps.h"
#include "ui/workspace/series_segments.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

Workspace withScannedSeries() {
  Workspace workspace;
  workspace.series.editOrAdd(scanKey).series = std::make_shared<const Series>(scannedSeries());
  return workspace;
}

// Returns two maps with a segment each, the first one active.
Workspace withTwoMaps() {
  const VoxelGeometry grid = gridOfMaps({4, 4, 4});
  Workspace w = withNewSegment(withScannedSeries(), scanKey, grid, {});
  return withNewSegment(std::move(w), scanKey, grid, {}, 1);
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

// Names are in one map, in the other one, and in both.
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

// Colours already in use are replaced. Equal colours within the file stay equal.
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
  // A recipe is followed twice.
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

// Ten colours in any of three maps are distinct, then they repeat.
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

void TestSegmentMaps::closedSeriesComeBackWithAll() {
  const Workspace w = withMapWorkedOn(withTwoMaps(), scanKey, 1);
  const Workspace closed = without(w, scanKey);
  QVERIFY(closed.segmentMaps.empty() && segmentMapsOf(closed, scanKey).empty());
  QVERIFY(withClosed(closed).segmentMaps == w.segmentMaps);
  // Maps made in the meantime do not collide with the restored ones.
  Workspace again = closed;
  again.series.editOrAdd(scanKey).series = std::make_shared<const Series>(scannedSeries());
  again = withClosed(withNewSegment(std::move(again), scanKey, gridOfMaps({4, 4, 4}), {}));
  std::vector<int> numbers;
  for (const SegmentMap* map : segmentMapsOf(again, scanKey)) numbers.push_back(map->number);
  QVERIFY((numbers == std::vector<int>{0, 1, 2}));
  // Restored maps take over how those are shown, as a session requires equal settings.
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
