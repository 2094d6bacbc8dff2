#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <functional>
#include <vector>

#include "ui/widgets/colour_button.h"
#include "ui/widgets/number_row.h"
#include "viewer/scene/scene.h"

namespace volumen {

/// Accesses a property of the scene for reading and writing.
template <class Value>
using Property = std::function<Value&(Scene&)>;

/// Connects properties of a scene with controls, one line each. show() fills the controls from a scene; user
/// input is passed to `edit`.
class Bindings {
 public:
  /// Called with the name of the undo step (also its merge key) and the change.
  using Edit = std::function<void(const QString& what, const std::function<void(Scene&)>& change)>;

  Bindings(Edit edit, std::function<void()> endGesture);

  void number(NumberRow* row, const QString& what, Property<double> property);
  void flag(QCheckBox* box, const QString& what, Property<bool> property);
  /// `values` are the meanings of the box's entries, in order.
  template <class Value>
  void choice(QComboBox* box, const QString& what, Property<Value> property, std::vector<Value> values);
  void colour(ColourButton* button, const QString& what, Property<glm::dvec3> property);

  /// Shows this scene in all controls without signals.
  void show(const Scene& scene) const;

 private:
  Edit edit_;
  std::function<void()> endGesture_;
  std::vector<std::function<void(Scene&)>> show_;
};

template <class Value>
void Bindings::choice(QComboBox* box, const QString& what, Property<Value> property,
                      std::vector<Value> values) {
  QObject::connect(box, &QComboBox::activated, box, [this, what, property, values](int n) {
    edit_(what, [&](Scene& s) { property(s) = values[n]; });
    endGesture_();
  });
  show_.push_back([box, property, values](Scene& s) {
    for (std::size_t n = 0; n < values.size(); ++n)
      if (values[n] == property(s)) box->setCurrentIndex(int(n));
  });
}

}  // namespace volumen
