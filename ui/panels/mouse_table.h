#pragma once

#include <QTabWidget>

#include "ui/tools/mouse_bindings.h"
#include "ui/workspace/session.h"

class QGridLayout;

namespace volumen {

/// Assigns actions to mouse buttons and the wheel with modifier keys, in slices and in 3D. Preferences store
/// only differences from the preset. Each box has the name of its slot (wordOf()).
class MouseTable : public QTabWidget {
  Q_OBJECT
 public:
  explicit MouseTable(Session& session, QWidget* parent = nullptr);

 private:
  QWidget* makePage(MousePlace place);
  void addBox(QGridLayout& grid, const MouseSlot& slot);

  Session& session_;
};

}  // namespace volumen
