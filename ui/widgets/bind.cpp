#include "ui/widgets/bind.h"

#include <QSignalBlocker>

namespace volumen {

void whenEdited(NumberRow* row, const std::function<void(double)>& edited,
                const std::function<void()>& done) {
  QObject::connect(row, &NumberRow::valueEdited, row, edited);
  QObject::connect(row, &NumberRow::gestureFinished, row, done);
}

void whenEdited(QDoubleSpinBox* field, const std::function<void(double)>& edited,
                const std::function<void()>& done) {
  QObject::connect(field, &QDoubleSpinBox::valueChanged, field, edited);
  QObject::connect(field, &QDoubleSpinBox::editingFinished, field, done);
}

void whenEdited(QCheckBox* box, const std::function<void(bool)>& edited, const std::function<void()>& done) {
  QObject::connect(box, &QCheckBox::toggled, box, [edited, done](bool on) {
    edited(on);
    done();
  });
}

void whenEdited(QComboBox* box, const std::function<void(int)>& edited, const std::function<void()>& done) {
  QObject::connect(box, &QComboBox::currentIndexChanged, box, [edited, done](int n) {
    if (n < 0) return;
    edited(n);
    done();
  });
}

void whenEdited(ColourButton* button, const std::function<void(glm::dvec3)>& edited,
                const std::function<void()>& done) {
  QObject::connect(button, &ColourButton::colourEdited, button, edited);
  QObject::connect(button, &ColourButton::gestureFinished, button, done);
}

void showIn(NumberRow* row, double value) { row->setValue(value); }

void showIn(QDoubleSpinBox* field, double value) {
  const QSignalBlocker quiet(field);
  if (field->value() != value) field->setValue(value);
}

void showIn(QCheckBox* box, bool value) {
  const QSignalBlocker quiet(box);
  box->setChecked(value);
}

void showIn(QComboBox* box, int value) {
  const QSignalBlocker quiet(box);
  box->setCurrentIndex(value);
}

void showIn(ColourButton* button, glm::dvec3 value) { button->setColour(value); }

}  // namespace volumen
