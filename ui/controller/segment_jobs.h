#pragma once

#include <QStringList>
#include <array>
#include <deque>
#include <functional>
#include <memory>

#include "ui/controller/segment_painter.h"
#include "ui/controller/step_work.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/session.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/segment/numbers.h"

namespace volumen {

/// What changes the voxels of a segment.
struct SegmentWork {
  SeriesKey series;
  VolumePtr volume;  ///< all of it: its grid is that of the labels
  int number = 0;    ///< of the segment; 0: a new one
  QString text;      ///< of the step to undo
  QString doing;     ///< of the job
  /// What else becomes of the segment; a new one gets name and colour where it has none.
  std::function<void(Segment&)> change{};
  /// Its voxels, on the job's thread, of the map as it is then. Null: the segment goes.
  std::function<Result<BitMask>(const SegmentMap& map, int number, const CancelToken& cancel)> make{};
  /// In place of that, and recorded: the steps that make them; what they are called on is that map.
  std::function<Result<StepsWanted>(const SegmentMap& map, int number, const CancelToken& cancel)> steps{};
  /// In place of all that: the map after it, on the job's thread.
  std::function<Result<SegmentMap>(const SegmentMap& map, const CancelToken& cancel)> makeAll{};
  std::function<void()> done{};  ///< called once it is a step
  /// Called with a sentence where it is none, which is told all the same; not for what was cancelled.
  std::function<void(const QString& why)> refused{};
};

/// What the segments of a map hold.
struct SegmentNumbers {
  std::shared_ptr<const LabelMap> labels;
  VolumePtr volume;
  std::array<std::int64_t, 256> voxels{};  ///< by number
  int number = 0;                          ///< of the segment that `values` is of; 0: none
  SegmentValues values;
};

/// Changes segments, measures and exports them; each a job, each change one undo step. Changes that are asked
/// for while one is made wait for their turn, and work on what that came to. None becomes a step in the
/// middle of a stroke: it comes after it.
class SegmentJobs : public QObject {
  Q_OBJECT
 public:
  SegmentJobs(Session& session, const SegmentPainter& painter, Jobs& jobs, QObject* parent = nullptr);
  /// Waits for what is being written.
  ~SegmentJobs() override;

  /// Ends in a step and ended(), or in failed() and ended(); nothing is done where the series was closed, or
  /// the segment removed, meanwhile.
  void change(const SegmentWork& work);
  /// Gives up what was to be measured before. Ends in measured(). All are of one grid.
  void measure(const std::shared_ptr<const LabelMap>& labels, int number, const VolumePtr& volume);
  /// Writes the segments of a series as the ending of `path` says. Ends in saved() or failed(). The map has
  /// labels.
  void save(const SegmentMap& map, const Series& series, const QString& path);

 Q_SIGNALS:
  /// Nothing is being changed any more.
  void ended();
  void measured(const volumen::SegmentNumbers& numbers);
  /// With the sentences that are to be known of it.
  void saved(const QStringList& files, const QStringList& notes, const volumen::SegmentMap& map);
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);

 private:
  void next();
  void begin(const SegmentWork& work, const SegmentMap& base);
  void take(const SegmentMap& base, const Result<SegmentMap>& made);
  void drop();
  void refuse(const SegmentWork& work, const QString& why);
  bool isMaking() const { return change_.isBusy() || takeLater_; }

  Session& session_;
  const SegmentPainter& painter_;
  std::deque<SegmentWork> waiting_;  // the first is being made where isMaking()
  std::function<void()> takeLater_;  // what the first came to, once the stroke has ended; null: nothing
  JobLane change_, measure_, save_;
};

}  // namespace volumen
