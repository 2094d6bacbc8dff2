#pragma once

#include <map>
#include <optional>
#include <set>

#include "ui/controller/segment_painter.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Makes the volumes that 3D views on screen draw for series with hidden tissue, and for CT without the
/// table. It does so when their segments or mask have changed: one series at a time, as a job, and a stroke
/// once it ends. Obsolete jobs are cancelled. Until a volume is ready the session keeps the old one.
class TissueJobs : public QObject {
  Q_OBJECT
 public:
  TissueJobs(Session& session, const SegmentPainter& painter, Jobs& jobs, QObject* parent = nullptr);

  /// Reports that a series was drawn unchanged. Only then is the table of a CT removed, so that the first
  /// picture does not wait.
  void drew(const SeriesKey& series);

 Q_SIGNALS:
  /// A sentence; not sent for cancelled work.
  void failed(const QString& sentence);

 private:
  void next();
  std::optional<MadeTissue> firstWanted() const;
  bool leavesTableOut(const LoadedSeriesPtr& series) const;
  void begin(const MadeTissue& wanted);
  void take(MadeTissue made);

  Session& session_;
  const SegmentPainter& painter_;
  std::optional<MadeTissue> underWay_;  // the last one begun
  std::set<SeriesKey> drawn_;
  std::map<SeriesKey, std::weak_ptr<const LoadedSeries>> withoutTable_;  // CT in which no table was found
  JobLane lane_;
};

}  // namespace volumen
