#pragma once

#include "ui/features/feature.h"

namespace volumen {

/// Imports segments from files into the series that the Segments panel shows: by menu, by a drop on the
/// panel, or on request of the workbench.
class SegmentsFromFiles : public Feature {
 public:
  SegmentsFromFiles(Workbench& bench, QWidget& panel);

  bool eventFilter(QObject* panel, QEvent* event) override;

 private:
  void take(const QStringList& paths);
  void ask();
  void showAction();

  QAction* import_;
};

}  // namespace volumen
