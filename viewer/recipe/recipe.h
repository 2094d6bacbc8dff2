#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "viewer/segment/acquired_slices.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/segment/segmented.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// What a field of a step holds: a number, a word or the name of a segment, yes or no, places in the patient
/// (mm, LPS), names of segments.
using StepValue = std::variant<double, std::string, bool, std::vector<glm::dvec3>, std::vector<std::string>>;

/// One step: what is done (the name of a row of stepKinds()), to which segment, and its fields by name; those
/// left out are as their row says.
struct Step {
  std::string kind, segment;
  std::map<std::string, StepValue> fields{};
  bool operator==(const Step&) const = default;
};

/// Segments, and the steps that make them from a volume. What steps name that is none of `segments` helps on
/// the way, and is not kept.
struct Recipe {
  std::string name, description;
  std::vector<std::string> modalities;  ///< that it is offered for; none: all
  std::vector<Segment> segments;        ///< numbers are 1, 2, ...
  std::vector<Step> steps;
  bool needsContrast = false;  ///< it is for series with contrast agent
  bool operator==(const Recipe&) const = default;
};

/// The most steps of a recipe.
inline constexpr std::size_t mostSteps = 10000;
/// The most segments that are held at once while one is followed, those that help on the way among them.
inline constexpr std::size_t mostMasks = 510;

/// Masks of one grid by the names of their segments.
using NamedMasks = std::map<std::string, BitMask>;

/// Does a step on the segments before it. The same voxels on any machine. The Error names the step and the
/// field, or says that it was cancelled; the masks are as they were then.
Status runStep(const Step& step, const Volume& volume, NamedMasks& masks, const CancelToken& cancel = {});

/// Says of a segment of a recipe how it is made, unless that is said or it is one of a range of values: by
/// the recipe alone, or with the help of a person where its steps name places or what was drawn.
Segment withRecipeNamed(Segment segment, const Recipe& recipe);

/// A recipe's segments of a volume; where they overlap, the later one's. With `slices`, of which the volume
/// is drawn, on these, too: what is decided voxel by voxel is decided by their own values. An Error as of
/// runStep(), with the number of the step.
Result<Segmented> follow(const Recipe& recipe, const Volume& volume, const CancelToken& cancel = {},
                         const AcquiredSlices& slices = {});

/// A recipe from its JSON (resources/docs/segment.md). Unknown steps, fields and words, and numbers out of
/// range, are refused by name.
Result<Recipe> readRecipe(const std::string& json);
/// With every field that is not as its row says.
std::string recipeJson(const Recipe& recipe);

/// Steps alone, a list of JSON, as they stand in a recipe.
Result<std::vector<Step>> readSteps(const std::string& json);
std::string stepsJson(const std::vector<Step>& steps);

/// Those compiled in from resources/recipes, in alphabetical order of their files.
const std::vector<Recipe>& builtInRecipes();

}  // namespace volumen
