#pragma once

#include <QStringList>
#include <deque>
#include <functional>
#include <memory>

#include "io/export/export_segments.h"
#include "results/segments/step_work.h"
#include "ui/controller/segment_painter.h"
#include "ui/document/job_lane.h"
#include "ui/workspace/session.h"
#include "viewer/segment/bit_mask.h"

namespace volumen {

/// A change of the voxels of a segment.
struct SegmentWork {
  SeriesKey series;
  VolumePtr volume;  ///< unmasked; its grid is that of the labels
  int number = 0;    ///< of the segment; 0 for a new one
  QString text;      ///< of the undo step
  QString doing;     ///< name of the job
  /// Other changes of the segment. A new one gets a missing name and colour.
  std::function<void(Segment&)> change{};
  /// Returns the steps to run on the current map, on the job's thread. If null, the segment is removed.
  std::function<Result<StepsWanted>(const SegmentMap& map, int number, const CancelToken& cancel)> steps{};
  /// Replaces `steps`: returns the changed map.
  std::function<Result<SegmentMap>(const SegmentMap& map, const CancelToken& cancel)> makeAll{};
  /// Replaces both: returns the changed maps of the series. As in the argument, the current map
  /// comes first, the others in order of their numbers.
  std::function<Result<std::vector<SegmentMap>>(const std::vector<SegmentMap>& maps,
                                                const CancelToken& cancel)>
      makeMaps{};
  std::function<void()> done{};  ///< called once it is an undo step
  /// Called with a sentence if it fails, which is reported anyway. Not called for cancelled work.
  std::function<void(const QString& why)> refused{};
  std::optional<int> map{};  ///< the map to change; empty for the current one at the time of the request
};

/// Returns work on the series of the Segments panel, which must have one.
SegmentWork workShown(const Session& session, const QString& text, const QString& doing);

/// Changes and exports segments, each as a job. Each change is one undo step. Later changes wait
/// for their turn and work on the result. No change becomes an undo step during a stroke; it follows the
/// stroke.
class SegmentJobs : public QObject {
  Q_OBJECT
 public:
  SegmentJobs(Session& session, const SegmentPainter& painter, Jobs& jobs, QObject* parent = nullptr);
  /// Waits until pending files are written.
  ~SegmentJobs() override;

  /// Requests a change. Ends in an undo step or a failure, and in ended(). Does nothing if the series was
  /// closed or the segment removed meanwhile.
  void change(const SegmentWork& work);
  /// Writes the segments of a series in the format of the extension of `path`. Ends in saved() or a failure.
  /// The maps have labels, and there is at least one.
  void save(const std::vector<SegmentMap>& maps, const Series& series, const QString& path);
  /// Writes finished surfaces to the files of exportSurfaces(). saved() then names no maps.
  void saveSurfaces(const std::shared_ptr<const std::vector<SurfaceToWrite>>& surfaces, const Series& series,
                    const std::vector<std::string>& files);

 Q_SIGNALS:
  /// No change is in progress any more.
  void ended();
  /// A change took voxels from other segments, or something failed. Not sent for cancelled work.
  void answered(const volumen::SegmentAnswer& answer);
  /// Files were written; `notes` are sentences about them.
  void saved(const QStringList& files, const QStringList& notes,
             const std::vector<volumen::SegmentMap>& maps);

 private:
  using Writing = std::function<Result<ExportedSegments>(const CancelToken& cancel)>;

  void write(const Writing& writing, const std::vector<SegmentMap>& maps);
  void next();
  void begin(const SegmentWork& work, const std::vector<SegmentMap>& bases);
  // The result of the first change, with a sentence about it.
  struct Made {
    Result<std::vector<SegmentMap>> maps;
    QString said{};
  };
  void take(const std::vector<SegmentMap>& bases, const Made& made);
  void drop();
  void refuse(const SegmentWork& work, const QString& why);
  bool isMaking() const { return change_.isBusy() || takeLater_; }

  Session& session_;
  const SegmentPainter& painter_;
  std::deque<SegmentWork> waiting_;  // while isMaking(), the first is in progress
  std::function<void()> takeLater_;  // applies the first result after the stroke; null for none
  JobLane change_, save_;
};

}  // namespace volumen
