#pragma once

#include <map>
#include <optional>
#include <set>

#include "ui/controller/segment_painter.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Makes what 3D views on screen draw of series whose tissue is not shown everywhere, and of CT without the
/// table, whenever their segments or what is taken away of them changed: a series at a time, as a job; of a
/// stroke once it ends. What is wanted no longer is given up. Until it is made the session keeps what was
/// there before.
class TissueJobs : public QObject {
  Q_OBJECT
 public:
  TissueJobs(Session& session, const SegmentPainter& painter, Jobs& jobs, QObject* parent = nullptr);

  /// A series was drawn as it is: only then is the table of a CT left out, so that the first picture does not
  /// wait.
  void drew(const SeriesKey& series);

 Q_SIGNALS:
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);

 private:
  void next();
  std::optional<MadeTissue> firstWanted() const;
  bool leavesTableOut(const LoadedSeriesPtr& series) const;
  void begin(const MadeTissue& wanted);
  void take(MadeTissue made);

  Session& session_;
  const SegmentPainter& painter_;
  std::optional<MadeTissue> underWay_;  // the last that was begun
  std::set<SeriesKey> drawn_;
  std::map<SeriesKey, std::weak_ptr<const LoadedSeries>> withoutTable_;  // in which no table was found
  JobLane lane_;
};

}  // namespace volumen
