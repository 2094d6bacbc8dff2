#pragma once

#include <optional>
#include <span>
#include <vector>

#include "viewer/recipe/recipe.h"

namespace volumen {

/// Input of a running step: all its fields, and the segments before it.
class StepInput {
 public:
  StepInput(const Step& complete, const Volume& whole, const NamedMasks& before, const CancelToken& token)
      : volume(whole), cancel(token), step_(complete), masks_(before) {}

  /// Returns the step's own segment as it was before; empty if there is none yet.
  BitMask own() const;
  /// Returns the segment named by a field; its existence has been checked.
  const BitMask& segment(const char* field) const;
  /// Name of the step's segment; mask of any segment that its fields name.
  const std::string& name() const { return step_.segment; }
  const BitMask& mask(const std::string& name) const { return masks_.at(name); }
  const std::vector<std::string>& names(const char* field) const {
    return std::get<std::vector<std::string>>(step_.fields.at(field));
  }
  bool namesSegment(const char* field) const { return !word(field).empty(); }
  double number(const char* field) const { return std::get<double>(step_.fields.at(field)); }
  const std::string& word(const char* field) const { return std::get<std::string>(step_.fields.at(field)); }
  bool flag(const char* field) const { return std::get<bool>(step_.fields.at(field)); }
  const std::vector<glm::dvec3>& places(const char* field) const {
    return std::get<std::vector<glm::dvec3>>(step_.fields.at(field));
  }
  /// Returns the voxels nearest to the points of a field, without those outside the grid.
  std::vector<glm::ivec3> voxelsAt(const char* field) const;

  const Volume& volume;
  const CancelToken& cancel;

 private:
  const Step& step_;
  const NamedMasks& masks_;
};

/// A parameter of a step. Its type is that of `byDefault`.
struct StepField {
  enum class Need { no, yes };
  enum class Number { real, whole };
  const char* name;
  const char* title;  ///< Label in the user interface
  const char* unit;   ///< "mm", "ml", "value", or empty
  StepValue byDefault;
  ValueRange allowed{};              ///< Range of a number, ends included
  std::vector<const char*> words{};  ///< Allowed words; if empty, a text is a segment name
  Need need = Need::no;              ///< `yes` if the field is required
  Number number = Number::real;      ///< `whole` for counts
};

/// A kind of step.
struct StepKind {
  /// Effect on its segment: it is made anew; changed; changed, but stays empty if empty; or only made
  /// smaller.
  enum class Use { makes, changes, reshapes, narrows };
  const char* name;
  const char* title;  ///< Short label in the user interface
  const char* says;   ///< Description of the resulting segment for users
  std::vector<StepField> fields;
  Use use;
  Result<BitMask> (*run)(const StepInput&);
  /// Used instead of `run` if the step also changes the segments in its field "with".
  Result<NamedMasks> (*runAll)(const StepInput&) = nullptr;
};

/// Kind of manual edits, which no recipe can repeat; running it is an Error.
inline constexpr const char* byHandStep = "byHand";
/// Kind that grows several segments from painted seeds (grow_from_seeds.h).
inline constexpr const char* growFromSeedsStep = "growFromSeeds";

/// Returns all kinds in menu order. A new kind is one row.
std::span<const StepKind> stepKinds();
/// Returns the kind of this name, or null.
const StepKind* stepKind(const std::string& name);

/// Return the rows of one file each (steps_*.cpp).
std::vector<StepKind> stepsOfValues();
std::vector<StepKind> stepsOfParts();
std::vector<StepKind> stepsOfShape();

}  // namespace volumen
