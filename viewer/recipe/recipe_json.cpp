#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "viewer/recipe/recipe.h"
#include "viewer/recipe/step_kinds.h"
#include "viewer/recipe/step_names.h"
#include "viewer/scene/json_fields.h"
#include "viewer/scene/number_text.h"
#include "viewer/scene/similar_name.h"
#include "viewer/volume/free_name.h"

namespace volumen {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t mostSegments = 255, mostPlaces = 100000;
constexpr double mostMm = 1e12;  // from the origin: farther away, voxel indices overflow

// Codes from files may lack some.
bool hasAllParts(const Code& code) {
  return !isBlank(code.value) && !isBlank(code.scheme) && !isBlank(code.meaning);
}

Code readCode(JsonFields* from, const char* name) {
  Code code;
  if (auto fields = from->object(name)) {
    (*fields)("value", code.value);
    (*fields)("scheme", code.scheme);
    (*fields)("meaning", code.meaning);
    fields->refuseOthers();
    if (!hasAllParts(code))
      from->refuse(from->pathOf(name), "must have a value, its scheme and its meaning, or be left out");
  }
  return code;
}

Segment readSegment(JsonFields fields) {
  Segment segment;
  fields("name", segment.label);
  if (isBlank(segment.label)) fields.refuse(fields.pathOf("name"), "must be the segment's name");
  fields("description", segment.description);
  segment.category = readCode(&fields, "category");
  segment.type = readCode(&fields, "type");
  segment.modifier = readCode(&fields, "modifier");
  if (fields.raw("colour")) {
    glm::dvec3 colour(0);
    fields("colour", colour);
    for (int n = 0; n < 3; ++n)
      if (!(colour[n] >= 0 && colour[n] <= 255) || colour[n] != double(int(colour[n])))
        fields.refuse(fields.pathOf("colour"), "must be three whole numbers from 0 to 255");
    segment.colour = glm::u8vec3(glm::clamp(colour, 0.0, 255.0));
  }
  fields.refuseOthers();
  return segment;
}

std::vector<glm::dvec3> readPlaces(JsonFields& fields, const char* name) {
  const nlohmann::json* const list = fields.raw(name);
  if (!list->is_array() || list->size() > mostPlaces) {
    fields.refuse(fields.pathOf(name),
                  "must be a list of at most " + std::to_string(mostPlaces) + " places, as in [[0, 10, -5]]");
    return {};
  }
  std::vector<glm::dvec3> places(list->size());
  for (std::size_t n = 0; n < places.size(); ++n) {
    fields.readNumbers((*list)[n], fields.pathOf(name, n), &places[n].x, 3);
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(places[n][axis]) <= mostMm))
        fields.refuse(fields.pathOf(name, n), "must be within " + numberText(mostMm) + " mm");
  }
  return places;
}

double readNumber(JsonFields& fields, const StepField& field) {
  double number = std::get<double>(field.byDefault);
  fields(field.name, number);
  if (!(number >= field.allowed.low && number <= field.allowed.high))
    fields.refuse(fields.pathOf(field.name), "must be from " + numberText(field.allowed.low) + " to " +
                                                 numberText(field.allowed.high) + ", not " +
                                                 numberText(number));
  if (field.number == StepField::Number::whole && number != std::floor(number))
    fields.refuse(fields.pathOf(field.name), "must be a whole number, not " + numberText(number));
  return number;
}

std::string readWord(JsonFields& fields, const StepField& field) {
  std::string word = std::get<std::string>(field.byDefault), allowed;
  fields(field.name, word);
  for (const char* one : field.words) allowed += (allowed.empty() ? "\"" : " or \"") + std::string(one) + '"';
  if (!field.words.empty() && std::ranges::find(field.words, word) == field.words.end())
    fields.refuse(fields.pathOf(field.name), "must be " + allowed + ", not " + JsonFields::quoted(word));
  return word;
}

std::vector<std::string> readNames(JsonFields& fields, const char* name) {
  const nlohmann::json* const list = fields.raw(name);
  std::vector<std::string> names;
  if (list->is_array() && list->size() < mostSegments)
    for (const nlohmann::json& one : *list)
      if (one.is_string()) names.push_back(one.get<std::string>());
  if (!list->is_array() || names.size() != list->size())
    fields.refuse(fields.pathOf(name),
                  R"(must be a list of names of at most 254 segments, as in ["Lungs", "Airways"])");
  return names;
}

void readField(JsonFields& fields, const StepField& field, Step& step) {
  if (!fields.raw(field.name)) {
    if (field.need == StepField::Need::yes)
      fields.refuse(fields.pathOf(field.name), "is missing: \"" + step.kind + "\" needs it");
    return;
  }
  StepValue& value = step.fields[field.name];
  if (std::holds_alternative<double>(field.byDefault))
    value = readNumber(fields, field);
  else if (std::holds_alternative<bool>(field.byDefault)) {
    bool flag = std::get<bool>(field.byDefault);
    fields(field.name, flag);
    value = flag;
  } else if (std::holds_alternative<std::string>(field.byDefault))
    value = readWord(fields, field);
  else if (std::holds_alternative<std::vector<std::string>>(field.byDefault))
    value = readNames(fields, field.name);
  else
    value = readPlaces(fields, field.name);
  if (value != field.byDefault) return;
  if (field.need == StepField::Need::yes)
    fields.refuse(fields.pathOf(field.name), "is empty: \"" + step.kind + "\" needs it");
  step.fields.erase(field.name);
}

Step readStep(JsonFields fields) {
  Step step;
  fields("step", step.kind);
  fields("segment", step.segment);
  if (isBlank(step.segment))
    fields.refuse(fields.pathOf("segment"), "must be the segment that the step makes");
  const StepKind* const kind = stepKind(step.kind);
  if (!kind) {
    std::vector<std::string> names;
    for (const StepKind& known : stepKinds()) names.emplace_back(known.name);
    const auto meant = similarName(step.kind, names);
    fields.refuse(fields.pathOf("step"), JsonFields::quoted(step.kind) + " is no step" +
                                             (meant ? ": \"" + *meant + "\" is" : std::string()));
    return step;
  }
  for (const StepField& field : kind->fields) readField(fields, field, step);
  if (isRangeReversed(step))
    fields.refuse(fields.pathOf("low"), "must be at most \"high\", which is " +
                                            numberText(std::get<double>(step.fields.at("high"))));
  fields.refuseOthers();
  return step;
}

void readSteps(JsonFields& fields, std::vector<Step>& steps) {
  fields.readList("steps", steps, readStep);
  if (steps.size() > mostSteps)
    fields.refuse("steps", "must be at most " + std::to_string(mostSteps) + " steps");
}

// Without a step that made it, a segment that this step leaves empty must be a mistyped name.
void checkOrder(const std::vector<Step>& steps, JsonFields& fields) {
  std::set<std::string> made;
  for (std::size_t n = 0; n < steps.size(); ++n) {
    const Step& step = steps[n];
    if (leavesEmpty(step) && !made.contains(step.segment)) {
      const auto meant = similarName(step.segment, {made.begin(), made.end()});
      return fields.refuse(fields.pathOf("steps", n) + ".segment",
                           JsonFields::quoted(step.segment) + " is made by no step before \"" + step.kind +
                               '"' + (meant ? ": " + JsonFields::quoted(*meant) + " is" : std::string()));
    }
    for (const std::string& name : changedBy(step)) made.insert(name);
  }
}

void checkNames(const Recipe& recipe, JsonFields& fields) {
  std::set<std::string> made, named;
  for (const Step& step : recipe.steps) made.insert(step.segment);
  for (std::size_t n = 0; n < recipe.segments.size(); ++n) {
    const std::string& name = recipe.segments[n].label;
    if (!named.insert(name).second)
      fields.refuse(fields.pathOf("segments", n),
                    "has the name of another segment, " + JsonFields::quoted(name));
    if (!made.contains(name))
      fields.refuse(fields.pathOf("segments", n), "is made by no step: " + JsonFields::quoted(name));
  }
}

Json codeJson(const Code& code) {
  return {{"value", code.value}, {"scheme", code.scheme}, {"meaning", code.meaning}};
}

Json segmentJson(const Segment& segment) {
  Json json{{"name", segment.label}};
  if (!segment.description.empty()) json["description"] = segment.description;
  for (const auto& [name, code] :
       {std::pair("category", &segment.category), {"type", &segment.type}, {"modifier", &segment.modifier}})
    if (hasAllParts(*code)) json[name] = codeJson(*code);
  if (segment.colour) json["colour"] = {segment.colour->r, segment.colour->g, segment.colour->b};
  return json;
}

Json valueJson(const StepValue& value) {
  if (const auto* places = std::get_if<std::vector<glm::dvec3>>(&value)) {
    Json list = Json::array();
    for (const glm::dvec3& p : *places) list.push_back({p.x, p.y, p.z});
    return list;
  }
  return std::visit(
      [](const auto& v) -> Json {
        if constexpr (std::is_constructible_v<Json, decltype(v)>) return v;
        return nullptr;
      },
      value);
}

Json stepJson(const Step& step) {
  Json json{{"step", step.kind}, {"segment", step.segment}};
  const StepKind* const kind = stepKind(step.kind);
  if (!kind) return json;
  for (const StepField& field : kind->fields)
    if (const auto given = step.fields.find(field.name);
        given != step.fields.end() && given->second != field.byDefault)
      json[field.name] = valueJson(given->second);
  return json;
}

}  // namespace

Result<Recipe> readRecipe(const std::string& json) {
  const auto parsed = parseJson(json, 64);
  if (!parsed) return parsed.error();
  std::string problem;
  JsonFields fields(*parsed, "", problem);
  Recipe recipe;
  int version = 0;
  fields("volumenRecipe", version);
  if (version != 1) fields.refuse("volumenRecipe", "must be 1: this is no recipe, or one of a newer program");
  fields("name", recipe.name);
  fields("description", recipe.description);
  if (const nlohmann::json* list = fields.raw("modalities")) {
    const bool isList = list->is_array() && std::all_of(list->begin(), list->end(),
                                                        [](const auto& one) { return one.is_string(); });
    if (isList)
      recipe.modalities = list->get<std::vector<std::string>>();
    else
      fields.refuse("modalities", "must be a list of words, as in [\"CT\"]");
  }
  fields("contrast", recipe.needsContrast);
  fields.readList("segments", recipe.segments, readSegment);
  readSteps(fields, recipe.steps);
  if (recipe.segments.empty() || recipe.segments.size() > mostSegments)
    fields.refuse("segments", "must be a list of 1 to " + std::to_string(mostSegments) + " segments");
  for (std::size_t n = 0; n < recipe.segments.size(); ++n) recipe.segments[n].number = int(n + 1);
  checkOrder(recipe.steps, fields);
  checkNames(recipe, fields);
  fields.refuseOthers();
  if (!problem.empty()) return Error{problem};
  return recipe;
}

Result<std::vector<Step>> readSteps(const std::string& json) {
  const auto parsed = parseJson("{\"steps\": " + json + "}", 64);
  if (!parsed) return parsed.error();
  std::string problem;
  JsonFields fields(*parsed, "", problem);
  std::vector<Step> steps;
  readSteps(fields, steps);
  fields.refuseOthers();
  if (!problem.empty()) return Error{problem};
  return steps;
}

std::string stepsJson(const std::vector<Step>& steps) {
  Json list = Json::array();
  for (const Step& step : steps) list.push_back(stepJson(step));
  return list.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string recipeJson(const Recipe& recipe) {
  Json json{{"volumenRecipe", 1}, {"name", recipe.name}};
  if (!recipe.description.empty()) json["description"] = recipe.description;
  if (!recipe.modalities.empty()) json["modalities"] = recipe.modalities;
  if (recipe.needsContrast) json["contrast"] = true;
  for (const Segment& segment : recipe.segments) json["segments"].push_back(segmentJson(segment));
  json["steps"] = Json::array();
  for (const Step& step : recipe.steps) json["steps"].push_back(stepJson(step));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace volumen
