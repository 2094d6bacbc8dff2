#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/segment/segmented.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// What a step's field can hold: a number, a word (of a list, or a segment's name), yes or no, places in the
/// patient (mm, LPS).
using StepValue = std::variant<double, std::string, bool, std::vector<glm::dvec3>>;

/// One step: what is done (the name of a row of stepKinds()), to which segment, and its fields by name; those
/// left out have their row's default.
struct Step {
  std::string kind, segment;
  std::map<std::string, StepValue> fields;
  bool operator==(const Step&) const = default;
};

/// Segments, and the steps that make them from a volume. What a step names that is none of `segments` is help
/// on the way, and not kept.
struct Recipe {
  std::string name, description;
  std::vector<std::string> modalities;  ///< that it is offered for; none: all
  std::vector<Segment> segments;
  std::vector<Step> steps;
  bool operator==(const Recipe&) const = default;
};

/// What a step works on.
struct StepInput {
  const Volume& volume;
  const std::map<std::string, BitMask>& masks;  ///< of segments so far; one that is not there is empty
  const Step& step;
  const CancelToken& cancel;

  BitMask own() const;  ///< of the step's own segment
  BitMask other(const char* field) const;
  double number(const char* field) const;
  bool flag(const char* field) const;
  const std::string& word(const char* field) const;
  const std::vector<glm::dvec3>& places(const char* field) const;
};

struct StepField {
  const char* name;
  const char* unit;  ///< "mm", "ml", "value"; empty: none
  StepValue byDefault;
  double low = 0, high = 0;             ///< of numbers, both allowed
  std::vector<const char*> words = {};  ///< of a word that is none of a segment
  bool required = false;
};

/// A row a kind of step.
struct StepKind {
  const char* name;
  const char* says;  ///< what it does, a short sentence for people
  std::vector<StepField> fields;
  Result<BitMask> (*run)(const StepInput&);
};
std::span<const StepKind> stepKinds();

/// A recipe's segments of a volume, in its order, in one label map (labels 1..; where they overlap the later
/// one's). The same voxels on any machine. The Error names the step.
Result<Segmented> follow(const Recipe& recipe, const Volume& volume, const CancelToken& cancel = {});

/// JSON (resources/docs/segment.md). Unknown steps, fields and words, and numbers out of range, are refused
/// by name.
Result<Recipe> readRecipe(const std::string& json);
std::string recipeJson(const Recipe& recipe);

}  // namespace volumen
