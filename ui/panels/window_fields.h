#pragma once

#include "ui/panels/value_fields.h"
#include "ui/workspace/session.h"

class QCheckBox;
class QComboBox;

namespace volumen {

/// The window of a projection in numbers, chosen by name, typed or inverted.
class WindowFields : public QWidget {
  Q_OBJECT
 public:
  explicit WindowFields(Session& session, QWidget* parent = nullptr);

 private:
  void showWindow();
  void setWindow(const std::optional<Window>& window);

  Session& session_;
  QComboBox* choices_;
  ValueFields* values_;
  QCheckBox* inverted_;
};

}  // namespace volumen
