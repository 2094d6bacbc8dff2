#pragma once

#include <QDoubleSpinBox>
#include <optional>

#include "ui/workspace/windows.h"

namespace volumen {

/// A window in four fields, with the unit of a series: centre and width, or its lowest and highest value.
class ValueFields : public QWidget {
  Q_OBJECT
 public:
  /// `name` begins the object names of the fields ("flat": "flatCentre" ...). Not `all`: the
  /// lowest and the highest value alone.
  ValueFields(const QString& name, bool all, QWidget* parent = nullptr);

  /// Shows a window of a series, in stored values, telling nobody.
  void setWindow(const Window& window, const Series& series);

 Q_SIGNALS:
  /// Its ends, in stored values; `dark` is above `bright` where it is inverted.
  void edited(volumen::WindowEnds ends);
  void gestureFinished();

 private:
  QDoubleSpinBox* addField(const QString& name, const QString& label);
  void typed(QDoubleSpinBox* field);

  std::optional<Window> window_;  // in the numbers on screen
  double toStored_ = 1;           // from these numbers
  QDoubleSpinBox *centre_ = nullptr, *width_ = nullptr, *low_, *high_;
};

}  // namespace volumen
