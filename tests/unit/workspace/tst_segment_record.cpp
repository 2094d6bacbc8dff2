// Guards the record of how segments were made: what of it a recipe holds where segments are removed, made
// anew or follow the curve; what was made by hand, and all that comes from it, is in no recipe, and said.
#include <algorithm>

#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "tests/unit/workspace/recorded_maps.h"
#include "ui/controller/segment_voxels.h"

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
};

namespace {

// Columns 0 .. 15.
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

}  // namespace

// A number that is changed later has the effect that it would have had then: B takes from A.
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
  // Of 2 into nothing, then over a voxel of 1: neither is what its range says any more.
  BitMask painted = maskOf(*map.labels, 2);
  painted.set({0, 0, 0});
  SegmentMap after = withHandMade(map, withMask(map, 2, painted));
  QVERIFY((recordedRecipe(after, {}).missing == Kinds{"A (2)"}));
  painted.set({4, 0, 0});
  after = withHandMade(after, withMask(after, 2, painted));
  QVERIFY((recordedRecipe(after, {}).missing == Kinds{"A", "A (2)"}));
  QVERIFY(difference(after, *volume).isEmpty());
  // Made anew, it is.
  after = withRange(after, 2, 8, 9, *volume);
  QVERIFY((recordedRecipe(after, {}).missing == Kinds{"A"}));
}

void TestSegmentRecord::whatWasThereBeforeIsInNoRecipe() {
  const VolumePtr volume = columnsVolume();
  SegmentMap map = withRange(withAnother(emptyMap(*volume)), 1, 3, 5, *volume);
  map.steps.clear();  // as sessions of before have it
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
  // Its number is another's.
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
  // Another one beside it, and one that takes of it.
  QVERIFY(isBound(withRange(withAnother(map), 2, 8, 9, *volume)));
  QVERIFY(!isBound(withRange(withAnother(map), 2, 4, 9, *volume)));
  QVERIFY(!isBound(*withStepsDone(map, {{{"grow", "1"}}, {1}}, *volume, {})));
  SegmentMap painted = map;
  LabelEdit edit(*map.labels);
  edit.set({3, 0, 0}, 0);
  painted.labels = std::make_shared<const LabelMap>(edit.done());
  QVERIFY(!isBound(painted));
  // By the curve.
  SegmentMap followed = withRange(map, 1, 4, 5, *volume);
  followed.segments[0].range = ValueRange{4, 5};
  QVERIFY(isBound(followed));
}

VOLUMEN_TEST(TestSegmentRecord);
#include "tst_segment_record.moc"
