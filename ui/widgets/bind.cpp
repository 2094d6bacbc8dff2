#include "ui/widgets/bind.h"

#include <QSignalBlocker>

namespace volumen {

Bindings::Bindings(Edit edit, std::function<void()> endGesture)
    : edit_(std::move(edit)), endGesture_(std::move(endGesture)) {}

void Bindings::number(NumberRow* row, const QString& what, Property<double> property) {
  QObject::connect(row, &NumberRow::valueEdited, row, [this, what, property](double value) {
    edit_(what, [&](Scene& s) { property(s) = value; });
  });
  QObject::connect(row, &NumberRow::gestureFinished, row, endGesture_);
  show_.push_back([row, property](Scene& s) { row->setValue(property(s)); });
}

void Bindings::flag(QCheckBox* box, const QString& what, Property<bool> property) {
  QObject::connect(box, &QCheckBox::clicked, box, [this, what, property](bool on) {
    edit_(what, [&](Scene& s) { property(s) = on; });
    endGesture_();
  });
  show_.push_back([box, property](Scene& s) { box->setChecked(property(s)); });
}

void Bindings::colour(ColourButton* button, const QString& what, Property<glm::dvec3> property) {
  QObject::connect(button, &ColourButton::colourEdited, button,
                   [this, what, property](glm::dvec3 c) { edit_(what, [&](Scene& s) { property(s) = c; }); });
  QObject::connect(button, &ColourButton::gestureFinished, button, endGesture_);
  show_.push_back([button, property](Scene& s) { button->setColour(property(s)); });
}

void Bindings::show(const Scene& scene) const {
  Scene copy = scene;
  for (const auto& one : show_) one(copy);
}

}  // namespace volumen
