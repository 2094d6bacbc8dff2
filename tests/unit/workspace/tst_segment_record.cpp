// Guards the record of how segments were made: whatever is done by steps in whatever order, with locks, cuts,
// segments that are removed, merged and split, its recipe makes the same voxels; what was made by hand, and
// all that comes from it, is in no recipe, and said.
#include <algorithm>
#include <array>
#include <map>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "ui/controller/segment_growing.h"
#include "ui/controller/segment_recipes.h"
#include "ui/controller/segment_voxels.h"
#include "ui/workspace/segment_maps.h"
#include "ui/workspace/segment_record.h"
#include "ui/workspace/segments.h"
#include "viewer/recipe/step_kinds.h"
#include "viewer/recipe/step_names.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

VolumePtr noise(Chance& chance) {
  const glm::ivec3 size(2 + chance.below(12), 2 + chance.below(10), 2 + chance.below(8));
  VolumePtr made = volumeOf<std::int16_t>(
      size, glm::dmat3(1), [&](glm::dvec3) { return chance.oneIn(4) ? -1000 : chance.below(6); });
  VolumeParts parts{made->geometry(), made->stored(), 1, 0, {}};
  parts.attributes.modality = "CT";
  return volumeFrom(std::move(parts));
}

SegmentMap emptyMap(const Volume& volume) {
  return {{"/data/ct", "1"}, {}, std::make_shared<const LabelMap>(volume.geometry()), {}};
}

// The recipe of a map's record, by way of its JSON.
Recipe readAgain(const SegmentMap& map) {
  const auto again = readRecipe(recipeJson(recordedRecipe(map, "CT").recipe));
  if (!again) throw std::runtime_error(again.message());
  return *again;
}

// What is different from the map; empty: nothing, but for what is missing.
QString difference(const SegmentMap& map, const Volume& volume) {
  const RecordedRecipe recorded = recordedRecipe(map, "CT");
  if (recorded.recipe.segments.empty()) return {};
  const auto made = follow(readAgain(map), volume);
  if (!made) return QString::fromStdString(made.message());
  for (const auto& [number, name] : namesInRecipe(map)) {
    const auto segment = std::ranges::find(made->segments, name, &Segment::label);
    if (segment == made->segments.end()) {
      if (std::ranges::count(recorded.missing, name) != 1) return QStringLiteral("a segment is lost");
      continue;
    }
    if (maskOf(made->labels, std::uint8_t(segment->number)) != maskOf(*map.labels, std::uint8_t(number)))
      return QString::fromStdString("other voxels: " + name + "\n" + recipeJson(recorded.recipe));
  }
  return {};
}

SegmentMap withAnother(SegmentMap map) {
  Segment segment;
  segment.number = *freeNumber(map);
  segment.label = "A";  // as others are called
  map = withSegment(std::move(map), segment);
  return withRecorded(std::move(map), {{"empty", stepNameOf(segment.number)}});
}

StepValue anyOf(const StepField& field, const SegmentMap& map, int own, Chance& chance) {
  if (std::holds_alternative<bool>(field.byDefault)) return chance.oneIn(2);
  if (std::holds_alternative<double>(field.byDefault)) {
    const double most = std::string_view(field.unit) == "ml" ? 0.02 : 3;
    return std::clamp(chance.between(0, most), field.allowed.low, field.allowed.high);
  }
  if (std::holds_alternative<std::vector<glm::dvec3>>(field.byDefault))
    return std::vector<glm::dvec3>{4.0 * chance.vector(), 4.0 * chance.vector()};
  if (!field.words.empty())
    return std::string(field.words[std::size_t(chance.below(int(field.words.size())))]);
  std::vector<std::string> others;
  for (const Segment& segment : map.segments)
    if (segment.number != own) others.push_back(stepNameOf(segment.number));
  if (others.empty()) return std::string();
  return others[std::size_t(chance.below(int(others.size())))];
}

// A step of any kind on a segment that is not locked.
StepsWanted anyStep(const SegmentMap& map, int own, Chance& chance, bool byHand) {
  const StepKind* kind = nullptr;
  do kind = &stepKinds()[std::size_t(chance.below(int(stepKinds().size())))];
  while (!byHand && std::string(kind->name) == byHandStep);
  StepsWanted wanted{{{kind->name, stepNameOf(own)}}, {own}};
  Step& step = wanted.steps.front();
  std::vector<std::string> with, locked;
  for (const Segment& segment : map.segments) {
    if (segment.number == own || !kind->runAll) continue;
    (segment.locked ? locked : with).push_back(stepNameOf(segment.number));
    if (!segment.locked) wanted.numbers.push_back(segment.number);
  }
  wanted.areApart = kind->runAll != nullptr;
  for (const StepField& field : kind->fields)
    if (!std::holds_alternative<std::vector<std::string>>(field.byDefault))
      step.fields[field.name] = anyOf(field, map, own, chance);
  if (kind->runAll) step.fields["with"] = with, step.fields["locked"] = locked;
  return wanted;
}

Recipe anyRecipe(Chance& chance) {
  Recipe recipe{"Any", {}, {}, {}, {}};
  for (const char* name : {"A", "B"}) {
    Segment segment;
    segment.number = int(recipe.segments.size()) + 1;
    segment.label = name;
    recipe.segments.push_back(segment);
  }
  recipe.steps = {{"range", "A", {{"low", double(chance.below(5))}}},
                  {"paint", "2", {{"at", std::vector<glm::dvec3>{3.0 * chance.vector()}}}},
                  {"range", "B", {{"high", double(chance.below(5))}}},
                  {"add", "B", {{"other", std::string("2")}}}};
  return recipe;
}

Mask anyCut(Chance& chance) {
  Mask mask;
  mask.tableRemoved = true;
  if (chance.oneIn(2)) return mask;
  Lasso lasso;
  lasso.points = {{-3, -3}, {3, -3}, {3, 2}};
  mask.lassos = {std::make_shared<const Lasso>(lasso)};
  return mask;
}

// One thing that the window does; as it was where that cannot be done.
SegmentMap act(SegmentMap map, const VolumePtr& volume, Chance& chance, bool byHand) {
  const int count = int(map.segments.size());
  if (count == 0 || (count < 5 && chance.oneIn(6))) return withAnother(std::move(map));
  Segment& chosen = map.segments[std::size_t(chance.below(count))];
  const int number = chosen.number;
  if (chance.oneIn(5)) chosen.locked = !chosen.locked;
  if (chosen.locked) return map;
  const CancelToken cancel;
  const auto done = [&](const Result<StepsWanted>& wanted) {
    const auto made = wanted ? withStepsDone(map, *wanted, *volume, cancel) : Result<SegmentMap>(map);
    return made ? *made : map;
  };
  const std::string name = stepNameOf(number);
  switch (chance.below(10)) {
    case 0:
      return withoutSegment(std::move(map), number);
    case 1: {
      const StepsWanted range{{{"range", name, {{"low", double(chance.below(6))}}}}, {number}};
      Mask cut = anyCut(chance);
      if (!byHand) cut.lassos.clear();
      return done(keptIn(range, {name}, *volume, cut, cancel));
    }
    case 2: {
      const Result<StepsWanted> parts = stepsOfSplit(map, number, 0.005, cancel);
      return done(parts);
    }
    case 3: {
      const PartUse use = PartUse(chance.below(3));
      const double guard = chance.oneIn(2) ? chance.between(0, 1.5) : 0;
      const char* touching = std::array{"faces", "edges", "corners"}[std::size_t(chance.below(3))];
      const PartWanted part{volume, {}, {2, 4}, 3.0 * chance.vector(), true, use, guard, touching};
      return done(stepsOfPart(part, map, number, cancel));
    }
    case 4: {
      const SegmentWork work = workOf(anyRecipe(chance), map.series, volume, {});
      const auto made = work.makeAll(map, cancel);
      return made ? *made : map;
    }
    case 5: {
      if (!byHand) return map;
      BitMask painted = maskOf(*map.labels, std::uint8_t(number));
      painted.set(glm::ivec3(chance.below(2), 1, chance.below(2)), chance.oneIn(2));
      return withHandMade(map, withMask(map, number, painted));
    }
    case 6: {
      Mask cut = chance.oneIn(2) ? anyCut(chance) : Mask();
      if (!byHand) cut.lassos.clear();
      const auto made = growthOf(map.series, volume, cut, GrowthRegion(chance.below(2))).makeAll(map, cancel);
      return made ? *made : map;
    }
    default:
      return done(anyStep(map, number, chance, byHand));
  }
}

}  // namespace

class TestSegmentRecord : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aRecipeMakesTheSameVoxels_data();
  void aRecipeMakesTheSameVoxels();
  void runAgainNothingChanges();
  void movedSegmentsTakeTheirStepsAlong_data() { aRecipeMakesTheSameVoxels_data(); }
  void movedSegmentsTakeTheirStepsAlong();
  void otherNumbersAreOtherVoxels();
  void whatWasPaintedIsInNoRecipe();
  void whatWasThereBeforeIsInNoRecipe();
  void aRemovedSegmentStaysWhereOthersComeFromIt();
  void whatIsMadeAnewForgetsWhatItWas();
  void aHelperOfTheSameNameIsNotTakenForTheMask();
  void whatFollowsTheCurveIsLetGoOnceItsVoxelsChange();
};

void TestSegmentRecord::aRecipeMakesTheSameVoxels_data() {
  QTest::addColumn<bool>("byHand");
  QTest::newRow("by steps alone, all is in it") << false;
  QTest::newRow("where some is made by hand, the rest is in it") << true;
}

void TestSegmentRecord::aRecipeMakesTheSameVoxels() {
  QFETCH(bool, byHand);
  const Seeds seeds = seedsOf(150, 5000);
  int compared = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const VolumePtr volume = noise(chance);
    SegmentMap map = emptyMap(*volume);
    for (int n = 0; n < 25; ++n) map = act(std::move(map), volume, chance, byHand);
    const RecordedRecipe recorded = recordedRecipe(map, "CT");
    QVERIFY2(byHand || recorded.missing.empty(), qPrintable(QString::number(seed)));
    const QString other = difference(map, *volume);
    QVERIFY2(other.isEmpty(), qPrintable(QStringLiteral("seed %1: %2").arg(seed).arg(other)));
    compared += int(recorded.recipe.segments.size());
  }
  QVERIFY(compared > seeds.count / 2);
}

void TestSegmentRecord::runAgainNothingChanges() {
  const Seeds seeds = seedsOf(60, 2000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const VolumePtr volume = noise(chance);
    SegmentMap map = emptyMap(*volume);
    for (int n = 0; n < 20; ++n) map = act(std::move(map), volume, chance, true);
    for (Segment& segment : map.segments) segment.locked = false;
    if (recordedRecipe(map, {}).recipe.segments.empty()) continue;
    const auto again =
        workOf(readAgain(map), map.series, volume, {}, RecipeUse::again).makeAll(map, CancelToken());
    QVERIFY2(again, again ? "" : again.message().c_str());
    QVERIFY2(*again->labels == *map.labels, qPrintable(QString::number(seed)));
    QVERIFY2(difference(*again, *volume).isEmpty(), qPrintable(QString::number(seed)));
  }
}

// Between two maps, in which more is done meanwhile.
void TestSegmentRecord::movedSegmentsTakeTheirStepsAlong() {
  QFETCH(bool, byHand);
  const Seeds seeds = seedsOf(40, 2000);
  int moves = 0, madeBySteps = 0;
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    Chance chance{std::uint64_t(seed)};
    const VolumePtr volume = noise(chance);
    std::vector<SegmentMap> maps(2, emptyMap(*volume));
    maps[1].number = 1;
    for (int n = 0; n < 30; ++n) {
      SegmentMap& map = maps[std::size_t(chance.below(2))];
      map = act(std::move(map), volume, chance, byHand);
      if (n % 10 != 9 || maps[0].segments.empty()) continue;
      const int number = maps[0].segments[std::size_t(chance.below(int(maps[0].segments.size())))].number;
      const auto moved = withSegmentMoved(maps, maps[0].number, number, maps[1].number);
      if (!moved) continue;
      maps = moved->maps;
      ++moves;
      madeBySteps += isMadeBySteps(maps.front(), maps.front().current);
    }
    for (const SegmentMap& map : maps) {
      const QString other = difference(map, *volume);
      QVERIFY2(other.isEmpty(), qPrintable(QStringLiteral("seed %1: %2").arg(seed).arg(other)));
      QVERIFY(byHand || recordedRecipe(map, "CT").missing.empty());
    }
  }
  QVERIFY(moves > seeds.count / 2 && madeBySteps > moves / 5);
}

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
