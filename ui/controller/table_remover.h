#pragma once

#include <QAction>
#include <QThreadPool>

#include "ui/workspace/session.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The action "Remove table": takes what lies outside the patient away from the series on screen, or brings
/// it back, as one undo step each. The volume without the table is made on a worker thread, once. Greyed,
/// with the reason as tooltip, where values are not HU.
class TableRemover : public QAction {
  Q_OBJECT
 public:
  explicit TableRemover(Session& session, QObject* parent = nullptr);
  /// Gives up what is under way.
  ~TableRemover() override;

  void cancel();

 Q_SIGNALS:
  /// A volume is being made / no longer.
  void begun();
  void ended();
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);

 private:
  void showState();
  void take(bool removed);
  void makeAgain(const ShownSeriesPtr& series);
  void make(const ShownSeriesPtr& series, const std::function<void(const ShownSeriesPtr&)>& use);
  void show(const ShownSeriesPtr& without);

  Session& session_;
  QThreadPool pool_;
  CancelToken cancel_;
  std::optional<SeriesKey> makingAgain_;
};

}  // namespace volumen
