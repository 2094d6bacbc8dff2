#include "viewer/recipe/recipe.h"

#include <algorithm>
#include <new>
#include <utility>

#include "viewer/recipe/recipe_texts.h"
#include "viewer/recipe/step_kinds.h"
#include "viewer/recipe/step_names.h"

namespace volumen {

namespace {

// With every field that its row has.
Step completed(Step step, const StepKind& kind) {
  for (const StepField& field : kind.fields) step.fields.emplace(field.name, field.byDefault);
  return step;
}

// The segments that a field names.
std::vector<std::string> namesIn(const StepField& field, const StepValue& value) {
  if (const auto* names = std::get_if<std::vector<std::string>>(&value)) return *names;
  const auto* name = std::get_if<std::string>(&value);
  if (!name || !field.words.empty() || (name->empty() && field.need == StepField::Need::no)) return {};
  return {*name};
}

// The Error: a segment that it names is not there.
Status checkSegments(const Step& step, const StepKind& kind, const NamedMasks& masks) {
  for (const StepField& field : kind.fields)
    for (const std::string& name : namesIn(field, step.fields.at(field.name)))
      if (!masks.contains(name))
        return Error{step.kind + ": " + field.name + " names the segment \"" + name +
                     "\", which no step before it made."};
  return {};
}

Result<NamedMasks> madeBy(const StepKind& kind, const StepInput& in) {
  if (kind.runAll) return kind.runAll(in);
  Result<BitMask> made = kind.run(in);
  if (!made) return made.error();
  return NamedMasks{{in.name(), std::move(*made)}};
}

// The step behind which nothing asks for a segment any more; for those of the recipe none.
std::map<std::string, std::size_t> lastSteps(const Recipe& recipe) {
  std::map<std::string, std::size_t> last;
  for (std::size_t n = 0; n < recipe.steps.size(); ++n)
    for (const auto& names : {changedBy(recipe.steps[n]), neededBy(recipe.steps[n])})
      for (const std::string& name : names) last[name] = n;
  for (const Segment& segment : recipe.segments) last[segment.label] = recipe.steps.size();
  return last;
}

}  // namespace

Status runStep(const Step& step, const Volume& volume, NamedMasks& masks, const CancelToken& cancel) {
  const StepKind* const kind = stepKind(step.kind);
  if (!kind) return Error{"There is no step \"" + step.kind + "\"."};
  const Step complete = completed(step, *kind);
  if (Status s = checkSegments(complete, *kind, masks); !s) return s;
  Result<NamedMasks> made = madeBy(*kind, StepInput(complete, volume, masks, cancel));
  if (cancel.cancelled()) return Error{"Cancelled."};
  if (!made) return Error{step.kind + ": " + made.message() + "."};
  for (auto& [name, mask] : *made) masks.insert_or_assign(name, std::move(mask));
  return {};
}

Result<Segmented> follow(const Recipe& recipe, const Volume& volume, const CancelToken& cancel) try {
  NamedMasks masks;
  const auto last = lastSteps(recipe);
  for (std::size_t n = 0; n < recipe.steps.size(); ++n) {
    const Status done = runStep(recipe.steps[n], volume, masks, cancel);
    if (cancel.cancelled()) return Error{"Cancelled."};
    if (!done) return Error{"Step " + std::to_string(n + 1) + ", " + done.message()};
    std::erase_if(masks, [&](const auto& named) { return last.at(named.first) == n; });
    if (masks.size() > mostMasks)
      return Error{"Step " + std::to_string(n + 1) + " makes more than " + std::to_string(mostMasks) +
                   " segments that later steps ask for."};
    cancel.setDone(double(n + 1) / double(recipe.steps.size()));
  }
  Segmented result{recipe.segments, LabelMap(volume.geometry())};
  for (std::size_t n = 0; n < result.segments.size(); ++n) {
    Segment& segment = result.segments[n];
    segment.number = int(n + 1);
    if (const auto mask = masks.find(segment.label); mask != masks.end())
      result.labels = withLabel(result.labels, std::uint8_t(n + 1), mask->second);
  }
  return result;
} catch (const std::bad_alloc&) {
  return Error{"There is not enough memory for the segments of the recipe."};
}

const std::vector<Recipe>& builtInRecipes() {
  static const std::vector<Recipe> all = [] {
    std::vector<Recipe> read;
    for (const std::string& text : recipeTexts()) read.push_back(*readRecipe(text));
    return read;
  }();
  return all;
}

}  // namespace volumen
