#pragma once

#include <QDoubleSpinBox>
#include <optional>

#include "ui/workspace/windows.h"

namespace volumen {

/// A window in four fields, in the unit of a series: centre and width, lowest and highest value.
class ValueFields : public QWidget {
  Q_OBJECT
 public:
  enum class Which { all, ends, centreAndWidth };
  /// `name` is the prefix of the fields' object names ("flat": "flatCentre" ...).
  ValueFields(const QString& name, Which which, QWidget* parent = nullptr);

  /// Shows a window of a series in stored values, without a signal. By default with four digits of its width.
  void setWindow(const Window& window, const Series& series, std::optional<int> decimals = {});

 Q_SIGNALS:
  /// The edited window, in stored values. `dark` is above `bright` if it is inverted.
  void edited(volumen::WindowEnds ends);
  void gestureFinished();

 private:
  void typed(QDoubleSpinBox* field);

  std::optional<Window> window_;  // in the numbers on screen
  double toStored_ = 1;           // factor from these numbers to stored values
  QDoubleSpinBox *centre_ = nullptr, *width_ = nullptr, *low_ = nullptr, *high_ = nullptr;
  std::vector<QDoubleSpinBox*> fields_;  // those of them that there are
};

}  // namespace volumen
