#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "viewer/segment/acquired_slices.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/segment/segmented.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

class AcquiredMasks;

/// Value of a step's field: a number, a word or segment name, a flag, points in patient space (mm, LPS), or
/// segment names.
using StepValue = std::variant<double, std::string, bool, std::vector<glm::dvec3>, std::vector<std::string>>;

/// One recipe step: its kind (a row of stepKinds()), its segment, and its fields by name. Missing fields have
/// the default of their row.
struct Step {
  std::string kind, segment;
  std::map<std::string, StepValue> fields{};
  bool operator==(const Step&) const = default;
};

/// Segments, and the steps that make them from a volume. Segments that only steps name are intermediate and
/// not kept.
struct Recipe {
  std::string name, description;
  std::vector<std::string> modalities;  ///< Modalities it is offered for; empty means all
  std::vector<Segment> segments;        ///< Numbered 1, 2, ...
  std::vector<Step> steps;
  bool needsContrast = false;  ///< True if it is for contrast-enhanced series
  bool operator==(const Recipe&) const = default;
};

/// Largest number of steps in a recipe.
inline constexpr std::size_t mostSteps = 10000;
/// Largest number of segments held at once while a recipe runs, intermediate ones included.
inline constexpr std::size_t mostMasks = 510;

/// Masks on one grid by segment name.
using NamedMasks = std::map<std::string, BitMask>;

/// Runs a step on the given segments. The voxels are the same on every machine. The Error names the step and
/// the field, or says that it was cancelled; `masks` is then unchanged.
Status runStep(const Step& step, const Volume& volume, NamedMasks& masks, const CancelToken& cancel = {});

/// Input of runSteps(): steps, the masks that they start from, and the names of the masks to return.
struct StepRun {
  std::span<const Step> steps;
  NamedMasks given{};
  std::set<std::string> kept{};
  bool numbered = false;  ///< an Error says which step failed
};
/// Runs steps one after another; with `onSlices`, on the acquired slices too. Returns the masks named in
/// `kept`. Other masks are dropped once no later step needs them. Reports progress to `cancel`. The Error is
/// that of runStep().
Result<NamedMasks> runSteps(StepRun run, const Volume& volume, const CancelToken& cancel = {},
                            AcquiredMasks* onSlices = nullptr);

/// Sets how a recipe's segment was made, unless that is set or the segment has a value range: automatic, or
/// semi-automatic if its steps use points or manual drawing.
Segment withRecipeNamed(Segment segment, const Recipe& recipe);

/// Runs a recipe on a volume; where segments overlap, the later one wins. With `slices`, from which the
/// volume was resampled, segments are made on these too, and per-voxel steps use the slices' own values. The
/// Error is that of runStep() with the step number.
Result<Segmented> follow(const Recipe& recipe, const Volume& volume, const CancelToken& cancel = {},
                         const AcquiredSlices& slices = {});

/// Reads a recipe from JSON (resources/docs/segment.md). The Error names unknown steps, fields and words,
/// numbers out of range, fractions of counts, reversed ranges, incomplete codes, and steps on a segment that
/// no step made.
Result<Recipe> readRecipe(const std::string& json);
/// Writes a recipe with all fields that differ from their defaults.
std::string recipeJson(const Recipe& recipe);

/// Read and write steps alone, as a JSON list, in the format of recipes.
Result<std::vector<Step>> readSteps(const std::string& json);
std::string stepsJson(const std::vector<Step>& steps);

/// Returns the recipes compiled in from resources/recipes, in alphabetical order of their files.
const std::vector<Recipe>& builtInRecipes();

}  // namespace volumen
