#include <algorithm>
#include <cmath>
#include <set>

#include "viewer/recipe/recipe.h"
#include "viewer/recipe/step_kinds.h"
#include "viewer/recipe/step_names.h"
#include "viewer/scene/fields.h"
#include "viewer/scene/number_text.h"
#include "viewer/scene/similar_name.h"
#include "viewer/volume/free_name.h"

namespace volumen {

namespace {

constexpr std::size_t mostSegments = 255, mostPlaces = 100000;
constexpr double mostMm = 1e12;  // from the origin: farther away, voxel indices overflow

// Codes from files may lack some.
bool hasAllParts(const Code& code) {
  return !isBlank(code.value) && !isBlank(code.scheme) && !isBlank(code.meaning);
}

void colourField(Fields& f, std::optional<glm::u8vec3>& colour) {
  if (colour) f.write("colour", {colour->r, colour->g, colour->b});
  if (!f.raw("colour")) return;
  glm::dvec3 read(0);
  f("colour", read);
  for (int n = 0; n < 3; ++n)
    f.require("colour", read[n] >= 0 && read[n] <= 255 && read[n] == double(int(read[n])),
              "must be three whole numbers from 0 to 255");
  colour = glm::u8vec3(glm::clamp(read, 0.0, 255.0));
}

// The values of a step's field, one function a type.
void valueOf(Fields& f, const StepField& field, bool& flag) { f(field.name, flag); }

void valueOf(Fields& f, const StepField& field, double& number) {
  f(field.name, number);
  f.require(field.name, number >= field.allowed.low && number <= field.allowed.high,
            "must be from " + numberText(field.allowed.low) + " to " + numberText(field.allowed.high) +
                ", not " + numberText(number));
  f.require(field.name, field.number != StepField::Number::whole || number == std::floor(number),
            "must be a whole number, not " + numberText(number));
}

void valueOf(Fields& f, const StepField& field, std::string& word) {
  f(field.name, word);
  std::string allowed;
  for (const char* one : field.words) allowed += (allowed.empty() ? "\"" : " or \"") + std::string(one) + '"';
  f.require(field.name, field.words.empty() || std::ranges::find(field.words, word) != field.words.end(),
            "must be " + allowed + ", not " + JsonFields::quoted(word));
}

void valueOf(Fields& f, const StepField& field, std::vector<std::string>& names) {
  f.texts(field.name, names, mostSegments - 1,
          R"(must be a list of names of at most 254 segments, as in ["Lungs", "Airways"])");
}

void valueOf(Fields& f, const StepField& field, std::vector<glm::dvec3>& places) {
  f(field.name, places,
    PointRule{"must be a list of at most " + std::to_string(mostPlaces) + " places, as in [[0, 10, -5]]", 3,
              mostPlaces, mostMm});
}

void stepField(Fields& f, const StepField& field, Step& step) {
  const bool isNeeded = field.need == StepField::Need::yes;
  const auto given = step.fields.find(field.name);
  StepValue value = given == step.fields.end() ? field.byDefault : given->second;
  if (f.reading() ? !f.raw(field.name) : value == field.byDefault)
    return f.require(field.name, !isNeeded, "is missing: \"" + step.kind + "\" needs it");
  std::visit([&](auto& v) { valueOf(f, field, v); }, value);
  if (value != field.byDefault)
    step.fields[field.name] = std::move(value);
  else
    f.require(field.name, !isNeeded, "is empty: \"" + step.kind + "\" needs it");
}

// Without a step that made it, a segment that this step leaves empty must be a mistyped name.
void checkOrder(const std::vector<Step>& steps, Fields& f) {
  std::set<std::string> made;
  for (std::size_t n = 0; n < steps.size(); ++n) {
    const Step& step = steps[n];
    if (leavesEmpty(step) && !made.contains(step.segment)) {
      const auto meant = similarName(step.segment, {made.begin(), made.end()});
      return f.refuse(f.pathOf("steps", n) + ".segment",
                      JsonFields::quoted(step.segment) + " is made by no step before \"" + step.kind + '"' +
                          (meant ? ": " + JsonFields::quoted(*meant) + " is" : std::string()));
    }
    for (const std::string& name : changedBy(step)) made.insert(name);
  }
}

void checkNames(const Recipe& recipe, Fields& f) {
  std::set<std::string> made, named;
  for (const Step& step : recipe.steps) made.insert(step.segment);
  for (std::size_t n = 0; n < recipe.segments.size(); ++n) {
    const std::string& name = recipe.segments[n].label;
    if (!named.insert(name).second)
      f.refuse(f.pathOf("segments", n), "has the name of another segment, " + JsonFields::quoted(name));
    if (!made.contains(name))
      f.refuse(f.pathOf("segments", n), "is made by no step: " + JsonFields::quoted(name));
  }
}

}  // namespace

static void fields(Fields& f, Code& code) {
  f("value", code.value);
  f("scheme", code.scheme);
  f("meaning", code.meaning);
}

static void fields(Fields& f, Segment& segment) {
  f("name", segment.label);
  f.require("name", !isBlank(segment.label), "must be the segment's name");
  f.unless({}, "description", segment.description);
  for (const auto& [name, code] :
       {std::pair("category", &segment.category), {"type", &segment.type}, {"modifier", &segment.modifier}}) {
    if (f.reading() || hasAllParts(*code)) f(name, *code);
    f.require(name, !f.raw(name) || hasAllParts(*code),
              "must have a value, its scheme and its meaning, or be left out");
  }
  colourField(f, segment.colour);
}

static void fields(Fields& f, Step& step) {
  f("step", step.kind);
  f("segment", step.segment);
  f.require("segment", !isBlank(step.segment), "must be the segment that the step makes");
  const StepKind* const kind = stepKind(step.kind);
  if (!kind) {
    std::vector<std::string> names;
    for (const StepKind& known : stepKinds()) names.emplace_back(known.name);
    const auto meant = similarName(step.kind, names);
    return f.refuse(f.pathOf("step"), JsonFields::quoted(step.kind) + " is no step" +
                                          (meant ? ": \"" + *meant + "\" is" : std::string()));
  }
  for (const StepField& field : kind->fields) stepField(f, field, step);
  if (isRangeReversed(step))
    f.refuse(f.pathOf("low"),
             "must be at most \"high\", which is " + numberText(std::get<double>(step.fields.at("high"))));
}

static void stepsField(Fields& f, std::vector<Step>& steps) {
  f("steps", steps);
  f.require("steps", steps.size() <= mostSteps, "must be at most " + std::to_string(mostSteps) + " steps");
}

static void fields(Fields& f, Recipe& recipe) {
  int version = f.reading() ? 0 : 1;
  f("volumenRecipe", version);
  f.require("volumenRecipe", version == 1, "must be 1: this is no recipe, or one of a newer program");
  f("name", recipe.name);
  f.unless({}, "description", recipe.description);
  if (f.reading() || !recipe.modalities.empty())
    f.texts("modalities", recipe.modalities, std::string::npos, "must be a list of words, as in [\"CT\"]");
  f.unless(false, "contrast", recipe.needsContrast);
  f.unless({}, "segments", recipe.segments);
  stepsField(f, recipe.steps);
}

Result<Recipe> readRecipe(const std::string& json) {
  const auto parsed = parseJson(json, 64);
  if (!parsed) return parsed.error();
  std::string problem;
  Fields f(JsonFields(*parsed, "", problem));
  Recipe recipe;
  fields(f, recipe);
  f.require("segments", !recipe.segments.empty() && recipe.segments.size() <= mostSegments,
            "must be a list of 1 to " + std::to_string(mostSegments) + " segments");
  for (std::size_t n = 0; n < recipe.segments.size(); ++n) recipe.segments[n].number = int(n + 1);
  checkOrder(recipe.steps, f);
  checkNames(recipe, f);
  f.refuseOthers();
  if (!problem.empty()) return Error{problem};
  return recipe;
}

Result<std::vector<Step>> readSteps(const std::string& json) {
  const auto parsed = parseJson("{\"steps\": " + json + "}", 64);
  if (!parsed) return parsed.error();
  std::string problem;
  Fields f(JsonFields(*parsed, "", problem));
  std::vector<Step> steps;
  stepsField(f, steps);
  f.refuseOthers();
  if (!problem.empty()) return Error{problem};
  return steps;
}

std::string stepsJson(const std::vector<Step>& steps) {
  return jsonOf(Recipe{{}, {}, {}, {}, steps})["steps"].dump(-1, ' ', false,
                                                             JsonFields::Json::error_handler_t::replace);
}

std::string recipeJson(const Recipe& recipe) {
  return jsonOf(recipe).dump(2, ' ', false, JsonFields::Json::error_handler_t::replace) + '\n';
}

}  // namespace volumen
