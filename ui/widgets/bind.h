#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "ui/widgets/colour_button.h"
#include "ui/widgets/fields.h"
#include "ui/widgets/number_row.h"

namespace volumen {

/// A property of a value, to read and to write.
template <class Whole, class Value>
struct Lens {
  std::function<Value(const Whole&)> get;
  std::function<void(Whole&, const Value&)> set;
};

/// Returns the lens on a member, or on a member of a member.
template <class Whole, class Value>
Lens<Whole, Value> at(Value Whole::*member) {
  return {[=](const Whole& w) { return w.*member; }, [=](Whole& w, const Value& v) { w.*member = v; }};
}
template <class Whole, class Part, class Value>
Lens<Whole, Value> at(Part Whole::*part, Value Part::*member) {
  return {[=](const Whole& w) { return w.*part.*member; },
          [=](Whole& w, const Value& v) { w.*part.*member = v; }};
}

/// Returns a property as the index of an entry of `values`; -1 if it is none of them.
template <class Whole, class Value>
Lens<Whole, int> among(const Lens<Whole, Value>& lens, const std::vector<Value>& values) {
  return {[=](const Whole& w) {
            const auto found = std::ranges::find(values, lens.get(w));
            return found == values.end() ? -1 : int(found - values.begin());
          },
          [=](Whole& w, int n) { lens.set(w, values[std::size_t(n)]); }};
}
/// Returns an enumeration as the index of an entry, for entries in the order of its enumerators.
template <class Whole, class Enum>
Lens<Whole, int> ordinal(const Lens<Whole, Enum>& lens) {
  return {[=](const Whole& w) { return int(lens.get(w)); }, [=](Whole& w, int n) { lens.set(w, Enum(n)); }};
}
/// Returns a share in percent.
template <class Whole>
Lens<Whole, double> percent(const Lens<Whole, double>& lens) {
  return {[=](const Whole& w) { return 100 * lens.get(w); },
          [=](Whole& w, double v) { lens.set(w, v / 100); }};
}

/// Calls `edited` with each value that the user enters, and `done` at the end of the gesture.
void whenEdited(NumberRow* row, const std::function<void(double)>& edited, const std::function<void()>& done);
void whenEdited(QDoubleSpinBox* field, const std::function<void(double)>& edited,
                const std::function<void()>& done);
void whenEdited(QCheckBox* box, const std::function<void(bool)>& edited, const std::function<void()>& done);
void whenEdited(QComboBox* box, const std::function<void(int)>& edited, const std::function<void()>& done);
void whenEdited(ColourButton* button, const std::function<void(glm::dvec3)>& edited,
                const std::function<void()>& done);
/// Shows a value without signals. A number that is shown already keeps its text.
void showIn(NumberRow* row, double value);
void showIn(QDoubleSpinBox* field, double value);
void showIn(QCheckBox* box, bool value);
void showIn(QComboBox* box, int value);
void showIn(ColourButton* button, glm::dvec3 value);

/// Receives a value.
template <class Whole>
using Follower = std::function<void(const Whole&)>;

/// A value that fields show and edit: a scene, preferences, options.
template <class Whole>
struct Source {
  /// Makes a change. `what` names the undo step, which takes in further changes of that name until `done`.
  std::function<void(const QString& what, const std::function<void(Whole&)>& change)> edit;
  std::function<void()> done = [] {};
  /// Calls `show` now, and after each change as long as `owner` lives.
  std::function<void(QObject* owner, const Follower<Whole>& show)> follow;

  /// Lets a field show and edit a property. Returns the field.
  template <class Field, class Value>
  Field* bind(Field* field, const QString& what, const Lens<Whole, Value>& lens) const {
    whenEdited(
        field,
        [change = edit, what, lens](const Value& value) {
          change(what, [&](Whole& whole) { lens.set(whole, value); });
        },
        done);
    follow(field, [field, lens, shown = std::optional<Value>()](const Whole& whole) mutable {
      const Value value = lens.get(whole);
      if (shown == value) return;
      shown = value;
      showIn(field, value);
    });
    return field;
  }
};

}  // namespace volumen
