#include "viewer/recipe/recipe.h"

#include <algorithm>
#include <new>
#include <utility>

#include "viewer/recipe/acquired_masks.h"
#include "viewer/recipe/recipe_texts.h"
#include "viewer/recipe/step_kinds.h"
#include "viewer/recipe/step_names.h"

namespace volumen {

namespace {

// Adds the defaults of all missing fields.
Step completed(Step step, const StepKind& kind) {
  for (const StepField& field : kind.fields) step.fields.emplace(field.name, field.byDefault);
  return step;
}

// Returns the segments that a field names.
std::vector<std::string> namesIn(const StepField& field, const StepValue& value) {
  if (const auto* names = std::get_if<std::vector<std::string>>(&value)) return *names;
  const auto* name = std::get_if<std::string>(&value);
  if (!name || !field.words.empty() || (name->empty() && field.need == StepField::Need::no)) return {};
  return {*name};
}

// Returns an Error if a named segment does not exist.
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

// Returns the last step that needs each segment; past the end for those kept.
std::map<std::string, std::size_t> lastSteps(const StepRun& run) {
  std::map<std::string, std::size_t> last;
  for (std::size_t n = 0; n < run.steps.size(); ++n)
    for (const auto& names : {changedBy(run.steps[n]), neededBy(run.steps[n])})
      for (const std::string& name : names) last[name] = n;
  for (const std::string& name : run.kept) last[name] = run.steps.size();
  return last;
}

// Returns the mask that a step is about to change.
NamedMasks ownBefore(const Step& step, const NamedMasks& masks) {
  const auto own = masks.find(step.segment);
  return own == masks.end() ? NamedMasks() : NamedMasks{*own};
}

// Segment n gets label n + 1.
LabelMap labelsOf(const Recipe& recipe, const NamedMasks& masks, const VoxelGeometry& grid) {
  LabelMap labels(grid);
  for (std::size_t n = 0; n < recipe.segments.size(); ++n)
    if (const auto mask = masks.find(recipe.segments[n].label); mask != masks.end())
      labels = withLabel(labels, std::uint8_t(n + 1), mask->second);
  return labels;
}

std::shared_ptr<const AcquiredLabels> acquiredOf(const Recipe& recipe, const AcquiredMasks& onSlices,
                                                 const VoxelGeometry& grid) {
  AcquiredLabels made{labelsOf(recipe, onSlices.masks(), grid)};
  for (std::size_t n = 0; n < recipe.segments.size(); ++n)
    if (onSlices.isInterpolated(recipe.segments[n].label)) made.interpolated.insert(int(n + 1));
  return std::make_shared<const AcquiredLabels>(std::move(made));
}

bool namesPlaces(const Step& step) {
  return std::ranges::any_of(step.fields, [](const auto& field) {
    return std::holds_alternative<std::vector<glm::dvec3>>(field.second);
  });
}

}  // namespace

Segment withRecipeNamed(Segment segment, const Recipe& recipe) {
  if (segment.algorithmType != SegmentAlgorithm::unsaid || segment.range) return segment;
  const std::vector<Step> steps = stepsBehind(recipe.steps, {segment.label});
  const bool isHelped = std::ranges::any_of(
      steps, [](const Step& step) { return step.kind == byHandStep || namesPlaces(step); });
  segment.algorithmType = isHelped ? SegmentAlgorithm::semiautomatic : SegmentAlgorithm::automatic;
  segment.algorithm = recipe.name.empty() ? "Recipe" : "Recipe " + recipe.name;
  return segment;
}

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

Result<NamedMasks> runSteps(StepRun run, const Volume& volume, const CancelToken& cancel,
                            AcquiredMasks* onSlices) {
  NamedMasks masks = std::move(run.given);
  const auto last = lastSteps(run);
  for (std::size_t n = 0; n < run.steps.size(); ++n) {
    const Step& step = run.steps[n];
    const std::string number = "Step " + std::to_string(n + 1);
    const NamedMasks before = onSlices ? ownBefore(step, masks) : NamedMasks();
    const Status done = runStep(step, volume, masks, cancel);
    if (cancel.cancelled()) return Error{"Cancelled."};
    if (!done) return Error{(run.numbered ? number + ", " : "") + done.message()};
    if (onSlices) onSlices->add(step, before, masks, cancel);
    std::erase_if(masks, [&](const auto& named) {
      const auto needed = last.find(named.first);
      return needed == last.end() || needed->second <= n;
    });
    if (onSlices) onSlices->keep(masks);
    if (masks.size() > mostMasks)
      return Error{number + " makes more than " + std::to_string(mostMasks) +
                   " segments that later steps ask for."};
    cancel.setDone(double(n + 1) / double(run.steps.size()));
  }
  return masks;
}

Result<Segmented> follow(const Recipe& recipe, const Volume& volume, const CancelToken& cancel,
                         const AcquiredSlices& slices) try {
  AcquiredMasks onSlices(slices);
  StepRun run{.steps = recipe.steps, .numbered = true};
  for (const Segment& segment : recipe.segments) run.kept.insert(segment.label);
  const auto masks = runSteps(std::move(run), volume, cancel, slices.volume ? &onSlices : nullptr);
  if (!masks) return masks.error();
  Segmented result{recipe.segments, labelsOf(recipe, *masks, volume.geometry())};
  for (std::size_t n = 0; n < result.segments.size(); ++n) {
    result.segments[n] = withRecipeNamed(recipe.segments[n], recipe);
    result.segments[n].number = int(n + 1);
  }
  if (slices.volume) result.acquired = acquiredOf(recipe, onSlices, slices.volume->geometry());
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
