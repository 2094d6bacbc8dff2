#include "ui/controller/segment_recipes.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "results/segments/step_work.h"
#include "results/text/text.h"
#include "viewer/recipe/step_names.h"

namespace volumen {

namespace {

// Returns the number of the map's segment for a recipe's segment.
Result<int> numberFor(const Segment& segment, const Recipe& recipe, SegmentMap& map, RecipeUse use) {
  if (use == RecipeUse::again)
    for (const auto& [number, name] : namesInRecipe(map)) {
      if (name != segment.label) continue;
      if (findSegment(map, number)->locked) return Error{name + " is locked: unlock it first."};
      return number;
    }
  const auto free = freeNumber(map);
  if (!free) return Error{"There are 255 segments, and no more fit: remove one first."};
  Segment made = withRecipeNamed(segment, recipe);
  made.number = *free;
  made.label = freeName(map, made.label);
  map = withSegment(std::move(map), std::move(made));
  return *free;
}

// Returns the steps of a recipe on this map, which gets the missing segments. A segment that the recipe
// changes first starts empty, even if the map has one of its name.
Result<StepsWanted> recipeStepsOf(const Recipe& recipe, SegmentMap& map, RecipeUse use) {
  StepsWanted wanted;
  std::map<std::string, std::string> names;
  for (const Segment& segment : recipe.segments) {
    const Result<int> number = numberFor(segment, recipe, map, use);
    if (!number) return number.error();
    names[segment.label] = stepNameOf(*number);
    wanted.numbers.push_back(*number);
  }
  std::set<std::string> begun;
  std::vector<Step> steps;
  for (const Step& step : recipe.steps) {
    steps.push_back(renamed(step, [&](const std::string& name) {
      const auto known = names.find(name);
      return known == names.end() ? helperNameOf(name) : known->second;
    }));
    for (const std::string& name : changedBy(steps.back()))
      if (begun.insert(name).second && !makesAnew(step)) wanted.steps.push_back({"empty", name});
  }
  for (const auto& [label, name] : names)
    if (begun.insert(name).second) wanted.steps.push_back({"empty", name});
  wanted.steps.insert(wanted.steps.end(), steps.begin(), steps.end());
  return wanted;
}

Result<SegmentMap> withRecipe(const Recipe& recipe, SegmentMap map, RecipeUse use, const Volume& volume,
                              const Mask& mask, const CancelToken& cancel) {
  Result<StepsWanted> wanted = recipeStepsOf(recipe, map, use);
  if (!wanted) return wanted.error();
  std::vector<std::string> names;
  for (const int number : wanted->numbers) names.push_back(stepNameOf(number));
  Result<SegmentMap> made =
      withStepsDone(std::move(map), keptIn(std::move(*wanted), names, volume, mask, cancel), volume, cancel);
  if (!made && !cancel.cancelled()) return Error{recipe.name + ": " + made.message()};
  return made;
}

}  // namespace

SegmentWork workOf(const Recipe& recipe, const SeriesKey& series, VolumePtr volume, const Mask& mask,
                   RecipeUse use) {
  SegmentWork work;
  work.series = series;
  work.volume = volume;
  work.text = use == RecipeUse::again ? tr("Run steps again") : tr("Recipe %1").arg(shownText(recipe.name));
  work.doing = tr("Following the recipe %1").arg(shownText(recipe.name));
  work.makeAll = [recipe, volume = std::move(volume), mask, use](const SegmentMap& map,
                                                                 const CancelToken& cancel) {
    return withRecipe(recipe, map, use, *volume, mask, cancel);
  };
  return work;
}

}  // namespace volumen
