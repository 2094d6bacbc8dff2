#pragma once

#include "ui/controller/segment_jobs.h"
#include "ui/features/feature.h"

namespace volumen {

/// Imports segments from files into the series that the Segments panel shows: by menu, by a drop on the
/// panel, or on request of the workbench.
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
