#pragma once

#include <QSlider>

#include "ui/widgets/fields.h"

namespace volumen {

/// A number with a slider and a field; the field has a wider range. Shift with the arrow keys is fine.
class NumberRow : public QWidget {
  Q_OBJECT
 public:
  /// `name` is the label and, without blanks, the field's object name.
  NumberRow(const QString& name, const NumberFormat& format, QWidget* parent = nullptr);

  void setName(const QString& name);
  /// Shows a value without signals.
  void setValue(double value);
  double value() const { return field_->value(); }
  QSlider* slider() const { return slider_; }
  QDoubleSpinBox* field() const { return field_; }

 Q_SIGNALS:
  void valueEdited(double value);
  void gestureFinished();

 protected:
  void changeEvent(QEvent*) override;

 private:
  void setWidths();
  int sliderOf(double value) const;
  double valueOf(int position) const;

  NumberFormat format_;
  QLabel* label_;
  QSlider* slider_;
  QDoubleSpinBox* field_;
};

}  // namespace volumen
