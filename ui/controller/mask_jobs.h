#pragma once

#include <deque>

#include "ui/document/job_lane.h"
#include "ui/workspace/session.h"

class QAction;

namespace volumen {

/// Takes parts of series away and brings them back, each as one undo step: the table, what was cut with the
/// scissors. The volume without them is made as a job, once, then the step is made; what is asked for
/// meanwhile waits for its turn. It makes those again, too, that a workspace that was read or undone asks
/// for.
class MaskJobs : public QObject {
  Q_OBJECT
 public:
  MaskJobs(Session& session, Jobs& jobs, QObject* parent = nullptr);

  /// "Remove table" of the series in focus: greyed, with the reason as tooltip, where values are not HU.
  QAction* tableAction() const { return table_; }
  /// "Reset scissors" of the series of the view in focus: all that was cut comes back.
  QAction* resetAction() const { return reset_; }

  void cut(const SeriesKey& series, const Lasso& lasso);

 Q_SIGNALS:
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);

 private:
  // The step to make; without a change the mask is made that the workspace has.
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
  std::deque<Step> steps_;  // the volume of the first is being made where the lane is busy
  bool isTaking_ = false;   // what was made: the next step waits
  JobLane lane_;
};

}  // namespace volumen
