// Guards recipes: their JSON in both directions, refusals by name, and that built-in ones can be read. Steps
// work on the segments that they name.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/seeds.h"
#include "tests/fixtures/small_volumes.h"
#include "tests/unit/suite.h"
#include "viewer/recipe/recipe.h"
#include "viewer/recipe/step_kinds.h"
#include "viewer/recipe/step_names.h"

using namespace volumen;
using namespace volumen::tests;

class TestRecipe : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void builtInOnesAreComplete();
  void everyKindSaysWhatItTakes();
  void randomOnesComeBack();
  void wrongOnesAreRefusedByName_data();
  void wrongOnesAreRefusedByName();
  void onlyAWholeCodeIsWritten();
  void stepsMakeSegments();
  void helpIsNotKept();
  void helpIsLetGo_data();
  void helpIsLetGo();
  void aStepThatCannotBeDoneIsNamed_data();
  void aStepThatCannotBeDoneIsNamed();
  void whatIsCancelledIsAnError();
};

namespace {

Segment named(const std::string& name, int number) {
  Segment segment;
  segment.number = number;
  segment.label = name;
  return segment;
}

VolumePtr ramp() {
  return volumeOf<std::int16_t>({16, 3, 2}, glm::dmat3(1), [](glm::dvec3 p) { return p.x; });
}

// Returns a row of the ramp as text, with "#" for columns of the label.
QString columns(const LabelMap& labels, int label) {
  QString text;
  for (int i = 0; i < labels.geometry().size.x; ++i)
    text += labels.at({i, 1, 1}) == label ? QLatin1Char('#') : QLatin1Char('.');
  return text;
}

StepValue anyValue(const StepField& field, const std::string& segment, Chance& chance) {
  if (std::holds_alternative<bool>(field.byDefault)) return chance.oneIn(2);
  if (std::holds_alternative<double>(field.byDefault)) {
    const double number =
        chance.between(std::max(field.allowed.low, -1e6), std::min(field.allowed.high, 1e6));
    return field.number == StepField::Number::whole ? std::round(number) : number;
  }
  if (std::holds_alternative<std::string>(field.byDefault))
    return field.words.empty() ? segment : std::string(field.words[chance.below(int(field.words.size()))]);
  if (std::holds_alternative<std::vector<std::string>>(field.byDefault))
    return std::vector<std::string>{segment, "\xc3\x84"};
  std::vector<glm::dvec3> places(std::size_t(1 + chance.below(4)));
  for (glm::dvec3& p : places) p = 300.0 * chance.vector();
  return places;
}

Recipe anyRecipe(std::uint64_t seed) {
  Chance chance(seed);
  Recipe recipe{"Recipe " + std::to_string(seed), chance.oneIn(2) ? "\"quoted\"\n" : "", {}, {}, {}};
  if (chance.oneIn(2)) recipe.modalities = {"CT", "MR"};
  recipe.needsContrast = chance.oneIn(2);
  const std::vector<std::string> names{"A", "B", "\xc3\x84"};
  for (int n = 0; n < 3; ++n) {
    Segment segment = named(names[std::size_t(n)], n + 1);
    if (chance.oneIn(2)) segment.type = {"272673000", "SCT", "Bone"};
    if (chance.oneIn(2)) segment.colour = glm::u8vec3(chance.below(256), chance.below(256), 7);
    recipe.segments.push_back(segment);
    recipe.steps.push_back({"range", names[std::size_t(n)]});
  }
  for (int n = chance.below(12); n > 0; --n) {
    const StepKind& kind = stepKinds()[std::size_t(chance.below(int(stepKinds().size())))];
    Step step{kind.name, names[std::size_t(chance.below(3))]};
    for (const StepField& field : kind.fields)
      if (field.need == StepField::Need::yes || chance.oneIn(2))
        step.fields[field.name] = anyValue(field, names[std::size_t(chance.below(3))], chance);
    if (isRangeReversed(step)) std::swap(step.fields.at("low"), step.fields.at("high"));
    std::erase_if(step.fields, [&](const auto& given) {
      return std::ranges::any_of(kind.fields, [&](const StepField& field) {
        return field.name == given.first && field.byDefault == given.second;
      });
    });
    recipe.steps.push_back(std::move(step));
  }
  return recipe;
}

}  // namespace

void TestRecipe::builtInOnesAreComplete() {
  QVERIFY(builtInRecipes().size() >= 7);
  for (const Recipe& recipe : builtInRecipes()) {
    QVERIFY(!recipe.name.empty() && !recipe.description.empty() && !recipe.modalities.empty());
    for (const Segment& segment : recipe.segments)
      QVERIFY2(segment.colour && segment.type != Code() && segment.category != Code(), segment.label.c_str());
    const auto again = readRecipe(recipeJson(recipe));
    QVERIFY2(again, again ? "" : again.message().c_str());
    QVERIFY(*again == recipe);
    QCOMPARE(recipe.needsContrast, recipe.name == "Vessels with contrast");
  }
}

void TestRecipe::everyKindSaysWhatItTakes() {
  for (const StepKind& kind : stepKinds()) {
    QVERIFY(stepKind(kind.name) == &kind);
    QVERIFY2(*kind.says != '\0', kind.name);
    for (const StepField& field : kind.fields) {
      const auto* number = std::get_if<double>(&field.byDefault);
      QVERIFY2(!number || (*number >= field.allowed.low && *number <= field.allowed.high), field.name);
    }
  }
}

void TestRecipe::randomOnesComeBack() {
  const Seeds seeds = seedsOf(300, 10000);
  for (int seed = seeds.first; seed < seeds.behindLast(); ++seed) {
    const Recipe recipe = anyRecipe(std::uint64_t(seed));
    const auto again = readRecipe(recipeJson(recipe));
    QVERIFY2(again, again ? "" : again.message().c_str());
    QVERIFY2(*again == recipe, qPrintable(QString::number(seed)));
  }
}

void TestRecipe::wrongOnesAreRefusedByName_data() {
  QTest::addColumn<QString>("recipe");
  QTest::addColumn<QString>("says");
  const auto step = [](const char* name, const char* text, const char* says) {
    QTest::newRow(name) << QStringLiteral(
                               R"({"volumenRecipe": 1, "segments": [{"name": "A"}], "steps": [%1]})")
                               .arg(QString::fromLatin1(text))
                        << QString::fromLatin1(says);
  };
  step("an unknown step", R"({"step": "ranges", "segment": "A"})",
       R"(steps[0].step "ranges" is no step: "range" is)");
  step("an unknown field", R"({"step": "grow", "segment": "A", "radius": 2})", "radius");
  step("a number out of range", R"({"step": "grow", "segment": "A", "radiusMm": -1})",
       "steps[0].radiusMm must be from 0 to 100, not -1");
  step("text for a number", R"({"step": "grow", "segment": "A", "radiusMm": "1"})", "steps[0].radiusMm");
  step("an unknown word", R"({"step": "largest", "segment": "A", "neighbours": "all"})",
       R"(must be "faces" or "edges" or "corners", not "all")");
  step("a field that is needed", R"({"step": "copy", "segment": "A"})", "steps[0].other is missing");
  step("places that are none", R"({"step": "keep", "segment": "A", "at": [1, 2, 3]})", "steps[0].at[0]");
  step("a field that is needed and holds nothing", R"({"step": "keep", "segment": "A", "at": []})",
       "steps[0].at is empty");
  step("smoothing that leaves no shape", R"({"step": "gaussian", "segment": "A", "sigmaMm": 21})",
       "steps[0].sigmaMm must be from 0 to 20, not 21");
  step("a place beyond all volumes", R"({"step": "keep", "segment": "A", "at": [[0, 1e300, 0]]})",
       "steps[0].at[0] must be within ");
  step("names that are none", R"({"step": "joint", "segment": "A", "with": "B"})",
       "steps[0].with must be a list of names");
  step("no segment", R"({"step": "invert"})", "steps[0].segment must be the segment");
  step("a segment of a blank name", R"({"step": "invert", "segment": " "})",
       "steps[0].segment must be the segment");
  const char* const made = R"({"step": "range", "segment": "A", "low": 1}, )";
  const auto behind = [&](const char* name, const QByteArray& text, const char* says) {
    step(name, (made + text).constData(), says);
  };
  behind("a step on a mistyped segment", R"({"step": "grow", "segment": "a"})",
         R"(steps[1].segment "a" is made by no step before "grow": "A" is.)");
  behind("a step on a segment that comes later",
         R"({"step": "largest", "segment": "Bone"}, {"step": "range", "segment": "Bone"})",
         R"(steps[1].segment "Bone" is made by no step before "largest".)");
  step("seeds that none has made", R"({"step": "growFromSeeds", "segment": "A", "with": ["B"]})",
       R"(steps[0].segment "A" is made by no step before "growFromSeeds".)");
  behind("a count that is not whole", R"({"step": "largest", "segment": "A", "count": 1.9999})",
         "steps[1].count must be a whole number, not 1.9999.");
  behind("a rank that is not whole", R"({"step": "part", "segment": "A", "other": "A", "rank": 2.5})",
         "steps[1].rank must be a whole number, not 2.5.");
  step("a range that is reversed", R"({"step": "range", "segment": "A", "low": 5, "high": 3})",
       R"(steps[0].low must be at most "high", which is 3.)");
  step("a range to paint on that is reversed",
       R"({"step": "paint", "segment": "A", "at": [[0, 0, 0]], "low": 5, "high": 3})",
       R"(steps[0].low must be at most "high", which is 3.)");
  step("nothing makes a segment", R"({"step": "invert", "segment": "B"})", R"(is made by no step: "A")");
  QTest::newRow("no recipe") << QStringLiteral("{}") << QStringLiteral("volumenRecipe must be 1");
  QTest::newRow("a newer one") << QStringLiteral(R"({"volumenRecipe": 2})")
                               << QStringLiteral("volumenRecipe must be 1");
  QTest::newRow("no JSON") << QStringLiteral("{,") << QStringLiteral("line 1");
  QTest::newRow("a blank name")
      << QStringLiteral(
             R"({"volumenRecipe": 1, "segments": [{"name": " \t"}], "steps": [{"step": "invert", "segment": " \t"}]})")
      << QStringLiteral("segments[0].name must be the segment's name");
  QTest::newRow("two of one name")
      << QStringLiteral(
             R"({"volumenRecipe": 1, "segments": [{"name": "A"}, {"name": "A"}], "steps": [{"step": "invert", "segment": "A"}]})")
      << QStringLiteral("segments[1] has the name of another segment");
  QTest::newRow("a colour that is none")
      << QStringLiteral(
             R"({"volumenRecipe": 1, "segments": [{"name": "A", "colour": [0.5, 0, 0]}], "steps": [{"step": "invert", "segment": "A"}]})")
      << QStringLiteral("segments[0].colour must be three whole numbers");
  const auto coded = [](const char* name, const char* field, const char* code) {
    QTest::newRow(name)
        << QStringLiteral(
               R"({"volumenRecipe": 1, "segments": [{"name": "A", "%1": %2}], "steps": [{"step": "invert", "segment": "A"}]})")
               .arg(QLatin1String(field), QLatin1String(code))
        << QStringLiteral("segments[0].%1 must have a value, its scheme and its meaning")
               .arg(QLatin1String(field));
  };
  coded("a code without its scheme", "type", R"({"value": "272673000", "meaning": "Bone"})");
  coded("a code without its meaning", "category", R"({"value": "85756007", "scheme": "SCT"})");
  coded("a code without its value", "modifier", R"({"scheme": "SCT", "meaning": "Left"})");
  QTest::newRow("modalities that are no list")
      << QStringLiteral(
             R"({"volumenRecipe": 1, "modalities": "CT", "segments": [{"name": "A"}], "steps": [{"step": "invert", "segment": "A"}]})")
      << QStringLiteral("modalities must be a list of words");
  QTest::newRow("an unknown field of the recipe")
      << QStringLiteral(
             R"({"volumenRecipe": 1, "author": "me", "segments": [{"name": "A"}], "steps": [{"step": "invert", "segment": "A"}]})")
      << QStringLiteral("author");
}

void TestRecipe::wrongOnesAreRefusedByName() {
  QFETCH(QString, recipe);
  QFETCH(QString, says);
  const auto read = readRecipe(recipe.toStdString());
  QVERIFY(!read);
  QVERIFY2(QString::fromStdString(read.message()).contains(says), read.message().c_str());
}

// Files may hold incomplete codes. A recipe of their segments must still be readable.
void TestRecipe::onlyAWholeCodeIsWritten() {
  Recipe recipe;
  recipe.segments = {named("A", 1)};
  recipe.segments[0].category = {"85756007", "SCT", "Tissue"};
  recipe.segments[0].type = {"272673000", "SCT", ""};
  recipe.steps = {{"range", "A"}};
  const auto again = readRecipe(recipeJson(recipe));
  QVERIFY2(again, again ? "" : again.message().c_str());
  QVERIFY(again->segments[0].category == recipe.segments[0].category);
  QVERIFY(again->segments[0].type == Code());
}

void TestRecipe::stepsMakeSegments() {
  Recipe recipe;
  recipe.segments = {named("Low", 1), named("Middle", 2)};
  recipe.steps = {{"range", "Low", {{"high", 8.0}}},
                  {"range", "Middle", {{"low", 6.0}, {"high", 11.0}}},
                  {"paint", "Low", {{"at", std::vector<glm::dvec3>{{5.5, 0, 0.5}}}, {"radiusMm", 1.2}}},
                  {"copy", "Last", {{"other", std::string("Middle")}}},
                  {"shrink", "Last", {{"radiusMm", 1.0}}},
                  {"subtract", "Low", {{"other", std::string("Last")}}}};
  const auto made = follow(recipe, *ramp());
  QVERIFY2(made, made ? "" : made.message().c_str());
  // Columns lie at -7.5 .. 7.5 mm. A ball about 5.5 mm paints column 13 and its neighbours.
  QCOMPARE(columns(made->labels, 1), QStringLiteral("######......###."));
  QCOMPARE(columns(made->labels, 2), QStringLiteral("......######...."));
  QCOMPARE(made->segments.size(), std::size_t(2));
}

void TestRecipe::helpIsNotKept() {
  Recipe recipe;
  recipe.segments = {named("A", 1)};
  recipe.steps = {{"range", "B", {{"low", 4.0}}}, {"copy", "A", {{"other", std::string("B")}}}};
  const auto made = follow(recipe, *ramp());
  QVERIFY(made && made->segments.size() == 1);
  QCOMPARE(columns(made->labels, 1), QStringLiteral("....############"));
}

void TestRecipe::helpIsLetGo_data() {
  QTest::addColumn<int>("names");
  QTest::addColumn<bool>("atOnce");
  QTest::addColumn<bool>("followed");
  QTest::newRow("thousands one behind the other") << 4000 << false << true;
  QTest::newRow("as many at once as may be") << 509 << true << true;
  QTest::newRow("one more") << 510 << true << false;
}

// A helper segment takes an eighth of a byte a voxel. Thousands for a large series would exceed any memory.
void TestRecipe::helpIsLetGo() {
  QFETCH(int, names);
  QFETCH(bool, atOnce);
  QFETCH(bool, followed);
  Recipe recipe;
  recipe.segments = {named("A", 1)};
  recipe.steps = {{"range", "A", {{"low", 4.0}}}};
  std::vector<Step> asking;
  for (int n = 0; n < names; ++n) {
    const std::string name = "help " + std::to_string(n);
    recipe.steps.push_back({"copy", name, {{"other", std::string("A")}}});
    (atOnce ? asking : recipe.steps).push_back({"intersect", "A", {{"other", name}}});
  }
  recipe.steps.insert(recipe.steps.end(), asking.begin(), asking.end());
  const auto made = follow(recipe, *ramp());
  QVERIFY2(made.ok() == followed, made ? "" : made.message().c_str());
  if (made)
    QCOMPARE(columns(made->labels, 1), QStringLiteral("....############"));
  else
    QCOMPARE(QString::fromStdString(made.message()),
             QStringLiteral("Step 511 makes more than 510 segments that later steps ask for."));
}

void TestRecipe::aStepThatCannotBeDoneIsNamed_data() {
  QTest::addColumn<QString>("kind");
  QTest::addColumn<QString>("field");
  QTest::addColumn<QString>("says");
  QTest::newRow("a segment that is not there")
      << QStringLiteral("subtract") << QStringLiteral("other")
      << QStringLiteral("Step 1, subtract: other names the segment \"B\", which no step before it made.");
  QTest::newRow("no such step") << QStringLiteral("melt") << QString()
                                << QStringLiteral("Step 1, There is no step \"melt\".");
  QTest::newRow("nothing to start from") << QStringLiteral("airTree") << QString()
                                         << QStringLiteral("Step 1, airTree: it has nothing to start from.");
}

void TestRecipe::aStepThatCannotBeDoneIsNamed() {
  QFETCH(QString, kind);
  QFETCH(QString, field);
  QFETCH(QString, says);
  Recipe recipe;
  recipe.segments = {named("A", 1)};
  recipe.steps = {{kind.toStdString(), "A"}};
  if (!field.isEmpty()) recipe.steps[0].fields[field.toStdString()] = std::string("B");
  const auto made = follow(recipe, *ramp());
  QVERIFY(!made);
  QCOMPARE(QString::fromStdString(made.message()), says);
}

void TestRecipe::whatIsCancelledIsAnError() {
  const CancelToken cancel;
  cancel.cancel();
  for (const Recipe& recipe : builtInRecipes()) {
    const auto made = follow(recipe, *ramp(), cancel);
    QVERIFY(!made);
    QCOMPARE(QString::fromStdString(made.message()), QStringLiteral("Cancelled."));
  }
}

VOLUMEN_TEST(TestRecipe);
#include "tst_recipe.moc"
