#pragma once

#include <deque>

#include "ui/document/job_lane.h"
#include "ui/workspace/session.h"

class QAction;

namespace volumen {

/// Masks parts of series and restores them: the table, and cuts with the scissors. Each is one undo step. The
/// masked volume is made once, as a job; then the step is made. Further requests wait for their turn. Masked
/// volumes are also made again when a loaded or undone workspace needs them.
class MaskJobs : public QObject {
  Q_OBJECT
 public:
  MaskJobs(Session& session, Jobs& jobs, QObject* parent = nullptr);

  /// "Remove table" for the series in focus. It is disabled, with the reason as tooltip, if values are not
  /// HU.
  QAction* tableAction() const { return table_; }
  /// "Reset scissors" for the series in focus restores everything that was cut.
  QAction* resetAction() const { return reset_; }

  void cut(const SeriesKey& series, const Lasso& lasso);

 Q_SIGNALS:
  /// A sentence; not sent for cancelled work.
  void failed(const QString& sentence);

 private:
  // The undo step to make. Without a change, the workspace's own mask is made.
  struct Step {
    SeriesKey series;
    QString text;
    std::function<void(Mask&)> change;
  };

  void ask(Step step);
  void next();
  void begin(const Mask& mask, const LoadedSeriesPtr& whole);
  void take(const Mask& before, const Mask& mask, const Result<LoadedSeriesPtr>& made);
  void drop();
  void giveUp(const Step& step, const QString& sentence);
  void showState();

  Session& session_;
  QAction *table_, *reset_;
  std::deque<Step> steps_;  // while the lane is busy, the volume of the first is being made
  bool isTaking_ = false;   // set while a result is applied; the next step waits
  JobLane lane_;
};

}  // namespace volumen
