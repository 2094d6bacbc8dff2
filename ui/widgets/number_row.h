#pragma once

#include <QDoubleSpinBox>
#include <QLabel>
#include <QSlider>

namespace volumen {

/// What a number may be and how it is shown.
struct NumberFormat {
  double low = 0, high = 1;
  int decimals = 2;
  QString suffix = {};       ///< " mm"
  bool logarithmic = false;  ///< the slider's scale; low must be > 0 then
};

/// A number on a slider and in a field that allows more than the slider: Shift with the arrow keys is fine.
class NumberRow : public QWidget {
  Q_OBJECT
 public:
  /// `name` labels the row and, without blanks, gives the field its object name.
  NumberRow(const QString& name, const NumberFormat& format, QWidget* parent = nullptr);

  void setName(const QString& name);
  /// Shows a value, telling nobody.
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
