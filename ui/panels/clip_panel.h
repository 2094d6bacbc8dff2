#pragma once

#include "ui/widgets/number_row.h"
#include "ui/workspace/session.h"

namespace volumen {

/// The clip box: how much each of its six sides cuts from the volume.
class ClipPanel : public QWidget {
  Q_OBJECT
 public:
  explicit ClipPanel(Session& session, QWidget* parent = nullptr);

 private:
  NumberRow* makeRow(const QString& name);
  void connectRow(int axis, bool high);
  void showClip();
  void nameSides();

  Session& session_;
  NumberRow *low_[3], *high_[3];
};

}  // namespace volumen
