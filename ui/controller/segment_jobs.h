#pragma once

#include <QStringList>
#include <array>
#include <deque>
#include <functional>
#include <memory>

#include "io/export/export_segments.h"
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
  /// In place of all that: the maps of the series after it, the first worked on. They are given so, too, the
  /// others by their numbers.
  std::function<Result<std::vector<SegmentMap>>(const std::vector<SegmentMap>& maps,
                                                const CancelToken& cancel)>
      makeMaps{};
  std::function<void()> done{};  ///< called once it is a step
  /// Called with a sentence where it is none, which is told all the same; not for what was cancelled.
  std::function<void(const QString& why)> refused{};
  std::optional<int> map{};  ///< that it works on; none: the one that is worked on as it is asked for
};

/// How many voxels the segments of a map have.
struct MapVoxels {
  std::shared_ptr<const LabelMap> labels;
  std::array<std::int64_t, 256> voxels{};  ///< by number
};

/// What the segments of a series hold.
struct SegmentNumbers {
  std::vector<MapVoxels> maps;  ///< the first is the one that is worked on
  VolumePtr volume;
  int number = 0;  ///< of the segment of the first map that `values` is of; 0: none
  SegmentValues values{};

  /// Whether both are of the same.
  bool areOf(const SegmentNumbers& other) const;
  /// Those of a map; null: it was not counted.
  const MapVoxels* of(const std::shared_ptr<const LabelMap>& labels) const;
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
  /// Gives up what was to be measured before. Ends in measured(). `wanted` says what of: all are of one grid.
  void measure(const SegmentNumbers& wanted);
  /// Writes the segments of a series as the ending of `path` says. Ends in saved() or failed(). The maps have
  /// labels, and there is one at least.
  void save(const std::vector<SegmentMap>& maps, const Series& series, const QString& path);
  /// The same of surfaces that were made, to the files that exportSurfaces() takes; saved() names no maps.
  void saveSurfaces(const std::shared_ptr<const std::vector<SurfaceToWrite>>& surfaces, const Series& series,
                    const std::vector<std::string>& files);

 Q_SIGNALS:
  /// Nothing is being changed any more.
  void ended();
  /// A change has become a step. `said`: changeText() of it.
  void changed(const QString& said);
  void measured(const volumen::SegmentNumbers& numbers);
  /// With the sentences that are to be known of it.
  void saved(const QStringList& files, const QStringList& notes,
             const std::vector<volumen::SegmentMap>& maps);
  /// A sentence; not for what was cancelled.
  void failed(const QString& sentence);

 private:
  using Writing = std::function<Result<ExportedSegments>(const CancelToken& cancel)>;

  void write(const Writing& writing, const std::vector<SegmentMap>& maps);
  void next();
  void begin(const SegmentWork& work, const std::vector<SegmentMap>& bases);
  // What the first change comes to, with what is to be said of it.
  struct Made {
    Result<std::vector<SegmentMap>> maps;
    QString said;
  };
  void take(const std::vector<SegmentMap>& bases, const Made& made);
  void drop();
  void refuse(const SegmentWork& work, const QString& why);
  bool isMaking() const { return change_.isBusy() || takeLater_; }

  Session& session_;
  const SegmentPainter& painter_;
  SegmentNumbers counted_;           // the last of each map: of what did not change they hold
  std::deque<SegmentWork> waiting_;  // the first is being made where isMaking()
  std::function<void()> takeLater_;  // what the first came to, once the stroke has ended; null: nothing
  JobLane change_, measure_, save_;
};

}  // namespace volumen
