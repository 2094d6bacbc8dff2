#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>

#include "ui/workspace/session.h"

namespace volumen {

/// The window of a projection in numbers, chosen by name, typed or inverted.
class WindowFields : public QWidget {
  Q_OBJECT
 public:
  explicit WindowFields(Session& session, QWidget* parent = nullptr);

 private:
  QDoubleSpinBox* makeField(const QString& name, const QString& label);
  void fillChoices();
  void showWindow();
  void setWindow(const std::optional<Window>& window);
  void typed();

  Session& session_;
  QComboBox* choices_;
  QDoubleSpinBox *centre_, *width_;
  QCheckBox* inverted_;
};

}  // namespace volumen
