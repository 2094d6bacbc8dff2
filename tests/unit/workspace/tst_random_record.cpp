// Guards the record of how segments were made, in random cases. After any steps in any order its recipe makes
// the same voxels, also with locks, cuts, and segments that are removed, merged, split and moved.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "results/segments/segment_maps.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "tests/unit/workspace/recorded_maps.h"
#include "ui/controller/segment_edits.h"
#include "ui/controller/segment_parts.h"
#include "ui/controller/segment_recipes.h"
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

StepValue anyOf(const StepField& field, const SegmentMap& map, int own, Chance& chance) {
  if (std::holds_alternative<bool>(field.byDefault)) return chance.oneIn(2);
  if (std::holds_alternative<double>(field.byDefault)) {
    const double most = std::string_view(field.unit) == "ml" ? 0.02 : 3;
    const double number = std::clamp(chance.between(0, most), field.allowed.low, field.allowed.high);
    return field.number == StepField::Number::whole ? std::round(number) : number;
  }
  if (std::holds_alternative<std::vector<glm::dvec3>>(field.byDefault)) {
    std::vector<glm::dvec3> places(std::string_view(field.name) == "outline" ? 3 : 2);
    for (glm::dvec3& p : places) p = 4.0 * chance.vector();
    return places;
  }
  if (!field.words.empty())
    return std::string(field.words[std::size_t(chance.below(int(field.words.size())))]);
  std::vector<std::string> others;
  for (const Segment& segment : map.segments)
    if (segment.number != own) others.push_back(stepNameOf(segment.number));
  if (others.empty()) return std::string();
  return others[std::size_t(chance.below(int(others.size())))];
}

// Returns a step of any kind on a segment that is not locked.
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
  if (isRangeReversed(step)) std::swap(step.fields.at("low"), step.fields.at("high"));
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

// Performs one action of the window. Returns the map unchanged if that is impossible.
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
      const PartWanted part{volume,
                            {},
                            {{}, 3.0 * chance.vector(), true},
                            {.range = {2, 4}, .partUse = use, .leakGuardMm = guard, .neighbours = touching}};
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

class TestRandomRecord : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aRecipeMakesTheSameVoxels_data();
  void aRecipeMakesTheSameVoxels();
  void runAgainNothingChanges();
  void movedSegmentsTakeTheirStepsAlong_data() { aRecipeMakesTheSameVoxels_data(); }
  void movedSegmentsTakeTheirStepsAlong();
};

void TestRandomRecord::aRecipeMakesTheSameVoxels_data() {
  QTest::addColumn<bool>("byHand");
  QTest::newRow("by steps alone, all is in it") << false;
  QTest::newRow("where some is made by hand, the rest is in it") << true;
}

void TestRandomRecord::aRecipeMakesTheSameVoxels() {
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

void TestRandomRecord::runAgainNothingChanges() {
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

// Segments move between two maps, which are edited further in between.
void TestRandomRecord::movedSegmentsTakeTheirStepsAlong() {
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

VOLUMEN_TEST(TestRandomRecord);
#include "tst_random_record.moc"
