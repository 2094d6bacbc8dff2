// Guards the record of how segments were made: what a recipe holds after segments are removed, remade or
// follow the curve. Parts made by hand, and all that derives from them, are in no recipe and are reported.
#include <QTemporaryDir>
#include <algorithm>

#include "io/export/export_segments.h"
#include "io/load.h"
#include "io/open.h"
#include "io/segmentation.h"
#include "tests/fixtures/fixtures.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "tests/unit/workspace/recorded_maps.h"
#include "ui/controller/segment_import.h"
#include "ui/controller/segment_parts.h"
#include "ui/controller/segment_recipes.h"
#include "ui/controller/segments_on_slices.h"
#include "ui/workspace/workspace.h"

using namespace volumen;
using namespace volumen::tests;

class TestSegmentRecord : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void otherNumbersAreOtherVoxels();
  void whatWasPaintedIsInNoRecipe();
  void whatWasThereBeforeIsInNoRecipe();
  void aRemovedSegmentStaysWhereOthersComeFromIt();
  void whatIsMadeAnewForgetsWhatItWas();
  void aHelperOfTheSameNameIsNotTakenForTheMask();
  void whatFollowsTheCurveIsLetGoOnceItsVoxelsChange();
  void whatIsEditedSaysSo_data();
  void whatIsEditedSaysSo();
  void filesSayWhatStepsMade();
  void aRecipeSaysThatItMadeIt();
  void whatAFileSaysLeavesAsItCame();
  void stepsAreDoneAgainOnUnevenSlices();
  void whatWasImportedOnUnevenSlicesLeavesAsItCame();
};

namespace {

// Returns a volume whose values are columns 0 .. 15.
VolumePtr columnsVolume() {
  return volumeOf<std::int16_t>({16, 3, 3}, glm::dmat3(1), [](glm::dvec3 p) { return p.x; });
}

SegmentMap withRange(SegmentMap map, int number, double low, double high, const Volume& volume) {
  const StepsWanted range{{{"range", stepNameOf(number), {{"low", low}, {"high", high}}}}, {number}};
  return *withStepsDone(std::move(map), range, volume, {});
}

std::vector<std::string> kindsOf(const SegmentMap& map) {
  std::vector<std::string> kinds;
  for (const Step& step : map.steps) kinds.push_back(step.kind);
  return kinds;
}

using Kinds = std::vector<std::string>;

// Opens the only series of a folder of the test data.
struct Opened {
  Series series;
  Loaded loaded;

  explicit Opened(const char* folder)
      : series(openStudy(dataPath(folder))->volumes.at(0)), loaded(*loadSeries(series)) {}
};

}  // namespace

// A changed number has the effect it would have had at its step: B takes voxels from A.
void TestSegmentRecord::otherNumbersAreOtherVoxels() {
  const VolumePtr volume = columnsVolume();
  SegmentMap map = withAnother(withAnother(emptyMap(*volume)));
  map = withRange(map, 1, 0, 5, *volume);
  map = withRange(map, 2, 8, 9, *volume);
  Recipe recipe = recordedRecipe(map, {}).recipe;
  for (Step& step : recipe.steps)
    if (step.kind == "range" && step.segment == "A (2)") step.fields["low"] = 3.0;
  const auto again = workOf(recipe, map.series, volume, {}, RecipeUse::again).makeAll(map, CancelToken());
  QVERIFY(again);
  QCOMPARE(maskOf(*again->labels, 1).count(), std::int64_t(3 * 9));
  QCOMPARE(maskOf(*again->labels, 2).count(), std::int64_t(7 * 9));
}

void TestSegmentRecord::whatWasPaintedIsInNoRecipe() {
  const VolumePtr volume = columnsVolume();
  SegmentMap map = withAnother(withAnother(withAnother(emptyMap(*volume))));
  for (const int number : {1, 2, 3}) map = withRange(map, number, 4 * number, 4 * number + 2, *volume);
  // Paints segment 2 over background, then over a voxel of segment 1. Neither then matches its range.
  BitMask painted = maskOf(*map.labels, 2);
  painted.set({0, 0, 0});
  SegmentMap after = withHandMade(map, withMask(map, 2, painted));
  QVERIFY((recordedRecipe(after, {}).missing == Kinds{"A (2)"}));
  painted.set({4, 0, 0});
  after = withHandMade(after, withMask(after, 2, painted));
  QVERIFY((recordedRecipe(after, {}).missing == Kinds{"A", "A (2)"}));
  QVERIFY(difference(after, *volume).isEmpty());
  // A remade segment is in the recipe again.
  after = withRange(after, 2, 8, 9, *volume);
  QVERIFY((recordedRecipe(after, {}).missing == Kinds{"A"}));
}

void TestSegmentRecord::whatWasThereBeforeIsInNoRecipe() {
  const VolumePtr volume = columnsVolume();
  SegmentMap map = withRange(withAnother(emptyMap(*volume)), 1, 3, 5, *volume);
  map.steps.clear();  // as in sessions without a record
  QVERIFY((recordedRecipe(map, {}).missing == Kinds{"A"}));
  map = withRange(withAnother(map), 2, 8, 9, *volume);
  QVERIFY((recordedRecipe(map, {}).missing == Kinds{"A"}));
  map = *withStepsDone(map, {{{"add", "2", {{"other", std::string("1")}}}}, {2}}, *volume, {});
  QVERIFY((recordedRecipe(map, {}).missing == Kinds{"A", "A (2)"}));
}

void TestSegmentRecord::aRemovedSegmentStaysWhereOthersComeFromIt() {
  const VolumePtr volume = columnsVolume();
  SegmentMap map = withRange(withAnother(emptyMap(*volume)), 1, 3, 5, *volume);
  map = withRange(withAnother(map), 2, 8, 9, *volume);
  SegmentMap alone = withoutSegment(map, 1);
  QVERIFY((kindsOf(alone) == Kinds{"range"}));
  map = *withStepsDone(map, {{{"add", "2", {{"other", std::string("1")}}}}, {2}}, *volume, {});
  map = withoutSegment(map, 1);
  QVERIFY((kindsOf(map) == Kinds{"range", "range", "subtract", "add"}));
  QVERIFY(difference(map, *volume).isEmpty());
  // Its number is used by another segment.
  map = withRange(withAnother(map), 1, 0, 1, *volume);
  QVERIFY(recordedRecipe(map, {}).missing.empty() && difference(map, *volume).isEmpty());
}

void TestSegmentRecord::whatIsMadeAnewForgetsWhatItWas() {
  const VolumePtr volume = columnsVolume();
  SegmentMap map = withRange(withAnother(emptyMap(*volume)), 1, 3, 5, *volume);
  map = *withStepsDone(map, {{{"grow", "1"}}, {1}}, *volume, {});
  QVERIFY((kindsOf(map) == Kinds{"range", "grow"}));
  map = withRange(map, 1, 4, 5, *volume);
  QVERIFY((kindsOf(map) == Kinds{"range"}));
}

void TestSegmentRecord::aHelperOfTheSameNameIsNotTakenForTheMask() {
  Mask mask;
  mask.tableRemoved = true;
  const StepsWanted wanted{{{"range", "Kept"}, {"copy", "1", {{"other", std::string("Kept")}}}}, {1}};
  const StepsWanted kept = keptIn(wanted, {"1"}, *columnsVolume(), mask, {});
  QCOMPARE(kept.steps.size(), std::size_t(4));
  QVERIFY(kept.steps[2].segment != "Kept");
  QVERIFY(kept.steps[3].fields.at("other") == StepValue(kept.steps[2].segment));
}

void TestSegmentRecord::whatFollowsTheCurveIsLetGoOnceItsVoxelsChange() {
  const VolumePtr volume = columnsVolume();
  SegmentMap map = withRange(withAnother(emptyMap(*volume)), 1, 3, 5, *volume);
  map.segments[0].range = ValueRange{3, 5};
  map.segments[0].span = CurveSpan{0, 1};
  const auto isBound = [&](const SegmentMap& after) {
    return withLetGo(map, after).segments[0].span.has_value();
  };
  QVERIFY(isBound(map));
  // Adds another segment beside it, then one that takes voxels of it.
  QVERIFY(isBound(withRange(withAnother(map), 2, 8, 9, *volume)));
  QVERIFY(!isBound(withRange(withAnother(map), 2, 4, 9, *volume)));
  QVERIFY(!isBound(*withStepsDone(map, {{{"grow", "1"}}, {1}}, *volume, {})));
  SegmentMap painted = map;
  LabelEdit edit(*map.labels);
  edit.set({3, 0, 0}, 0);
  painted.labels = std::make_shared<const LabelMap>(edit.done());
  QVERIFY(!isBound(painted));
  // The change follows the curve.
  SegmentMap followed = withRange(map, 1, 4, 5, *volume);
  followed.segments[0].range = ValueRange{4, 5};
  QVERIFY(isBound(followed));
}

void TestSegmentRecord::whatIsEditedSaysSo_data() {
  QTest::addColumn<int>("before");
  QTest::addColumn<int>("painted");
  QTest::addColumn<int>("smoothed");
  QTest::addColumn<QByteArray>("name");
  using enum SegmentAlgorithm;
  QTest::newRow("automatic") << int(automatic) << int(semiautomatic) << int(semiautomatic)
                             << QByteArray("net, edited");
  QTest::newRow("semiautomatic") << int(semiautomatic) << int(semiautomatic) << int(semiautomatic)
                                 << QByteArray("net, edited");
  QTest::newRow("by hand") << int(manual) << int(manual) << int(semiautomatic) << QByteArray("net");
}

// One segment comes from a file, the other one is beside it.
void TestSegmentRecord::whatIsEditedSaysSo() {
  QFETCH(int, before);
  QFETCH(int, painted);
  QFETCH(int, smoothed);
  QFETCH(QByteArray, name);
  const VolumePtr volume = columnsVolume();
  SegmentMap map = withAnother(withAnother(emptyMap(*volume)));
  BitMask mask(volume->geometry());
  for (int i = 0; i < 5; ++i) mask.set({i, 1, 1});
  map = withHandMade(map, withMask(map, 1, mask));
  map.segments[0].algorithmType = SegmentAlgorithm(before);
  map.segments[0].algorithm = "net";
  map.segments[0].trackingUid = "1.2.3";
  const Workspace workspace = withSegmentMap({}, map);
  const auto first = [&](const SegmentMap& after) {
    return withSegmentMap(workspace, after).segmentMaps[0].segments[0];
  };
  QVERIFY(first(map) == map.segments[0]);
  QVERIFY(first(withRange(map, 2, 8, 9, *volume)) == map.segments[0]);  // beside it
  mask.set({0, 0, 0});
  const Segment byHand = first(withMask(map, 1, mask));
  QCOMPARE(int(byHand.algorithmType), painted);
  QCOMPARE(byHand.algorithm, name.toStdString());
  QCOMPARE(byHand.trackingUid, std::string("1.2.3"));
  const Segment again = first(*withStepsDone(map, {{{"grow", "1"}}, {1}}, *volume, {}));
  QCOMPARE(int(again.algorithmType), smoothed);
}

void TestSegmentRecord::filesSayWhatStepsMade() {
  const VolumePtr volume = columnsVolume();
  SegmentMap map = withAnother(withAnother(emptyMap(*volume)));
  map = withRange(map, 1, 3, 5, *volume);
  map = *withStepsDone(map, {{{"largest", "1"}}, {1}}, *volume, {});
  BitMask mask(volume->geometry());
  mask.set({9, 1, 1});
  map = withHandMade(map, withMask(map, 2, mask));
  const std::vector<Segment> written = segmentedOf({map})[0].segments;
  QCOMPARE(int(written[0].algorithmType), int(SegmentAlgorithm::semiautomatic));
  QCOMPARE(written[0].algorithm, std::string("Range, Keep largest"));
  QVERIFY(written[1] == map.segments[1] && written[1].algorithmType == SegmentAlgorithm::unsaid);
}

void TestSegmentRecord::aRecipeSaysThatItMadeIt() {
  const VolumePtr volume = columnsVolume();
  const Recipe recipe{"Mine", {}, {}, {{.number = 1, .label = "A"}}, {{"range", "A", {{"low", 3.0}}}}};
  const auto made = workOf(recipe, {}, volume, {}, RecipeUse::add).makeAll(emptyMap(*volume), CancelToken());
  QVERIFY(made);
  const Segment& segment = made->segments.back();
  QCOMPARE(int(segment.algorithmType), int(SegmentAlgorithm::automatic));
  QCOMPARE(segment.algorithm, std::string("Recipe Mine"));
}

// Passes from a DICOM segmentation into the window, and from there into another one.
void TestSegmentRecord::whatAFileSaysLeavesAsItCame() {
  NEED_DATA(dataPath("segment-cases"));
  const Opened ct("dicom-geometry/ct-tiny-23x38x3/image");
  const SegmentWork work = importOf(QString::fromStdString(dataPath("segment-cases/provenance/auto.dcm")),
                                    ct.series, ct.loaded.drawn, {});
  const auto imported = work.makeMaps({emptyMap(*ct.loaded.drawn)}, CancelToken());
  QVERIFY2(imported, imported ? "" : imported.message().c_str());
  const SegmentMap& map = imported->front();
  const Segment came = loadSegmentation(dataPath("segment-cases/provenance/auto.dcm"))->segments[0];
  const QTemporaryDir folder;
  const std::string path = folder.filePath(QStringLiteral("a.dcm")).toStdString();
  const auto left = [&](const SegmentMap& written) {
    const auto done =
        exportSegments(path, *segmentedOnSlices({written}, ct.series, CancelToken()), ct.series);
    return done ? loadSegmentation(path)->segments[0] : Segment{};
  };
  Segment unchanged = left(map);
  unchanged.colour = came.colour;  // it had none
  QVERIFY(unchanged == came);
  BitMask mask = maskOf(*map.labels, std::uint8_t(map.segments[0].number));
  mask.set({0, 0, 0}, !mask.at({0, 0, 0}));
  const Workspace workspace = withSegmentMap({}, map);
  const Segment edited =
      left(withSegmentMap(workspace, withMask(map, map.segments[0].number, mask)).segmentMaps[0]);
  QCOMPARE(int(edited.algorithmType), int(SegmentAlgorithm::semiautomatic));
  QCOMPARE(edited.algorithm, came.algorithm + ", edited");
  QCOMPARE(edited.trackingUid, came.trackingUid);
  QVERIFY(edited.region == came.region);
}

namespace {

// Returns the acquired slices that a segment marks in a file, such as "0 2 4".
QString slicesMarked(const SegmentMap& written, const Series& series, int number) {
  const auto made = segmentedOnSlices({written}, series, CancelToken());
  QStringList slices;
  const BitMask mask = maskOf((*made)[0].acquired->labels, std::uint8_t(number));
  for (int k = 0; k < mask.size().z; ++k)
    if (mask.at({11, 19, k})) slices << QString::number(k);
  return slices.join(QLatin1Char(' '));
}

}  // namespace

// Slices 0, 2, 4 and 6 have 300 HU, the others 100. Those at 9, 23 and 30 mm are not on the drawn grid.
void TestSegmentRecord::stepsAreDoneAgainOnUnevenSlices() {
  NEED_DATA(dataPath("segment-cases"));
  const Opened ct("segment-cases/uneven");
  SegmentMap map = withAnother(withAnother(emptyMap(*ct.loaded.drawn)));
  map = withRange(map, 1, 200, 3000, *ct.loaded.drawn);
  const auto marked = [&](const SegmentMap& written) { return slicesMarked(written, ct.series, 1); };
  QCOMPARE(marked(map), QStringLiteral("0 2 4 6"));
  QVERIFY((*segmentedOnSlices({map}, ct.series, CancelToken()))[0].acquired->interpolated.empty());
  // Painted voxels stay at their positions: 9 mm takes those of 8 mm.
  const SegmentMap painted =
      withHandMade(map, withMask(map, 1, inverted(BitMask(ct.loaded.drawn->geometry()))));
  QCOMPARE(marked(painted), QStringLiteral("0 1 2 3 4 5 6"));
  QVERIFY((*segmentedOnSlices({painted}, ct.series, CancelToken()))[0].acquired->interpolated.contains(1));
}

void TestSegmentRecord::whatWasImportedOnUnevenSlicesLeavesAsItCame() {
  NEED_DATA(dataPath("segment-cases"));
  const Opened ct("segment-cases/uneven");
  const SegmentMap made = withRange(withAnother(emptyMap(*ct.loaded.drawn)), 1, 200, 3000, *ct.loaded.drawn);
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("a.dcm"));
  QVERIFY(
      exportSegments(path.toStdString(), *segmentedOnSlices({made}, ct.series, CancelToken()), ct.series));
  QStringList told;
  const SegmentWork work =
      importOf(path, ct.series, ct.loaded.drawn, [&](const QStringList& sentences) { told = sentences; });
  const auto imported = work.makeMaps({emptyMap(*ct.loaded.drawn)}, CancelToken());
  QVERIFY2(imported, imported ? "" : imported.message().c_str());
  work.done();
  QCOMPARE(told.filter(QStringLiteral("unevenly spaced")).size(), 1);
  const SegmentMap& map = imported->front();
  const int number = map.segments.at(0).number;
  QCOMPARE(slicesMarked(map, ct.series, number), QStringLiteral("0 2 4 6"));
  QVERIFY((*segmentedOnSlices({map}, ct.series, CancelToken()))[0].acquired->interpolated.empty());
  const SegmentMap painted =
      withHandMade(map, withMask(map, number, inverted(BitMask(ct.loaded.drawn->geometry()))));
  QCOMPARE(slicesMarked(painted, ct.series, number), QStringLiteral("0 1 2 3 4 5 6"));
}

VOLUMEN_TEST(TestSegmentRecord);
#include "tst_segment_record.moc"
