#pragma once

#include <deque>

#include "ui/derivations/masked_volumes.h"

class QAction;

namespace volumen {

/// Masks parts of series and restores them: the table, and cuts with the scissors. Each is one undo step,
/// made once its volume is there. Further requests wait for their turn.
class Masking : public QObject {
  Q_OBJECT
 public:
  Masking(Session& session, Jobs& jobs);

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
  // An undo step to make.
  struct Step {
    SeriesKey series;
    QString text;
    std::function<void(Mask&)> change;
  };

  void ask(Step step);
  void next();
  bool hasEnded(const Step& step);
  void keepMade();
  std::optional<PoolKey> nextKey() const;
  Mask maskAfter(const Step& step) const;
  void showState();

  Session& session_;
  QAction *table_, *reset_;
  std::deque<Step> steps_;  // the volume of the first is being made
  bool isMaking_ = false;   // set within next(), which changes the workspace
  MaskedVolumes volumes_;
};

}  // namespace volumen
