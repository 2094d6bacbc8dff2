#pragma once

#include <optional>
#include <span>
#include <vector>

#include "viewer/recipe/recipe.h"

namespace volumen {

/// A step at work: its fields, all of them, and the segments before it.
class StepInput {
 public:
  StepInput(const Step& complete, const Volume& whole, const NamedMasks& before, const CancelToken& token)
      : volume(whole), cancel(token), step_(complete), masks_(before) {}

  /// The step's segment before it; empty where there is none yet.
  BitMask own() const;
  /// The segment that a field names; checked to be there.
  const BitMask& segment(const char* field) const;
  /// The name of the step's segment, and the mask of any that its fields name.
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
  /// The voxels of the grid nearest to the places of a field; those outside are left out.
  std::vector<glm::ivec3> voxelsAt(const char* field) const;

  const Volume& volume;
  const CancelToken& cancel;

 private:
  const Step& step_;
  const NamedMasks& masks_;
};

/// What a step can be told. Its type is that of `byDefault`.
struct StepField {
  enum class Need { no, yes };
  enum class Number { real, whole };
  const char* name;
  const char* title;  ///< for people
  const char* unit;   ///< "mm", "ml", "value"; empty: none
  StepValue byDefault;
  ValueRange allowed{};              ///< of a number, both ends inside
  std::vector<const char*> words{};  ///< that a text may be; none: it is the name of a segment
  Need need = Need::no;              ///< whether it must be given
  Number number = Number::real;      ///< whole: it counts something
};

/// A kind of step.
struct StepKind {
  /// What becomes of its segment: it is made, whatever it was; changed; changed, but left empty where it is
  /// empty; or only made smaller.
  enum class Use { makes, changes, reshapes, narrows };
  const char* name;
  const char* title;  ///< a few words, for people
  const char* says;   ///< what it makes of its segment, for people
  std::vector<StepField> fields;
  Use use;
  Result<BitMask> (*run)(const StepInput&);
  /// In place of that where it changes the segments of its field "with", too.
  Result<NamedMasks> (*runAll)(const StepInput&) = nullptr;
};

/// The kind of what no recipe can do again; to follow it is an Error.
inline constexpr const char* byHandStep = "byHand";
/// The kind that grows several segments into what lies around them (grow_from_seeds.h).
inline constexpr const char* growFromSeedsStep = "growFromSeeds";

/// All of them, in the order of a menu. A new one is a row.
std::span<const StepKind> stepKinds();
/// Null: there is none of this name.
const StepKind* stepKind(const std::string& name);

/// The rows of one file each (steps_*.cpp).
std::vector<StepKind> stepsOfValues();
std::vector<StepKind> stepsOfParts();
std::vector<StepKind> stepsOfShape();

}  // namespace volumen
