#pragma once

#include <QThreadPool>
#include <deque>

#include "ui/workspace/session.h"
#include "viewer/volume/cancel.h"

class QAction;

namespace volumen {

/// Takes parts of series away and brings them back, each as one undo step: the table, what was cut with the
/// scissors. The volume without them is made on a worker thread, once, then the step is made; what is asked
/// for meanwhile waits for its turn. It makes those again, too, that a workspace that was read or undone
/// asks for.
class Masker : public QObject {
  Q_OBJECT
 public:
  explicit Masker(Session& session, QObject* parent = nullptr);
  /// Gives up what is under way.
  ~Masker() override;

  /// "Remove table" of the series in focus: greyed, with the reason as tooltip, where values are not HU.
  QAction* tableAction() const { return table_; }
  /// "Reset scissors" of the series of the view in focus: all that was cut comes back.
  QAction* resetAction() const { return reset_; }

  void cut(const SeriesKey& series, const Lasso& lasso);
  /// Gives up all that is asked for.
  void cancel();

 Q_SIGNALS:
  /// A volume is being made / no longer.
  void begun(const QString& what);
  void ended();
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);

 private:
  // The step to make; without a change the mask is made that the workspace has.
  struct Job {
    SeriesKey series;
    QString text;
    std::function<void(Mask&)> change;
  };

  void ask(Job job);
  void next();
  void begin(const Mask& mask, const ShownSeriesPtr& whole);
  void take(const Mask& before, const Mask& mask, const Result<ShownSeriesPtr>& made);
  void giveUp(const Job& job, const QString& sentence);
  void showState();

  Session& session_;
  QAction *table_, *reset_;
  QThreadPool pool_;
  std::deque<Job> jobs_;  // the first is under way where isRunning_
  bool isRunning_ = false;
  CancelToken cancel_;
};

}  // namespace volumen
