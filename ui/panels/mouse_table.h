#pragma once

#include <QTabWidget>

#include "ui/tools/mouse_bindings.h"
#include "ui/workspace/session.h"

class QGridLayout;

namespace volumen {

/// What each button and the wheel do with each key held, in slices and in 3D: a box each, of which the
/// preferences keep what differs from the preset. A box is called as its slot (wordOf()).
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
