#pragma once

#include "ui/controller/segment_jobs.h"
#include "ui/features/feature.h"

namespace volumen {

/// Segments of files become segments of the series that the panel is about: asked for in the menu, dropped on
/// the panel, or requested of the workbench.
class SegmentsFromFiles : public Feature {
 public:
  SegmentsFromFiles(Workbench& bench, SegmentJobs& segmenter, QWidget& panel);

  bool eventFilter(QObject* panel, QEvent* event) override;

 private:
  void take(const QStringList& paths);
  void ask();
  void showAction();

  SegmentJobs& segmenter_;
  QAction* import_;
};

}  // namespace volumen
