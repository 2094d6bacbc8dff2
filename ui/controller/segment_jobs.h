#pragma once

#include <memory>

#include "ui/document/job_lane.h"
#include "ui/workspace/segment_map.h"
#include "viewer/segment/label_statistics.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// Makes segments, measures and saves them; each a job.
class SegmentJobs : public QObject {
  Q_OBJECT
 public:
  explicit SegmentJobs(Jobs& jobs, QObject* parent = nullptr);
  /// Waits for what is being written.
  ~SegmentJobs() override;

  /// Labels the voxels of the segment's range in the volume of the series, but what the mask takes away;
  /// gives up what was to be segmented before. Ends in segmented() or failed().
  void segment(const SeriesKey& series, VolumePtr volume, const Mask& mask, const Segment& segment);
  /// Of the voxels with this number; gives up what was to be measured before. Ends in measured(). Both have
  /// one grid.
  void measure(const std::shared_ptr<const LabelMap>& labels, int number, VolumePtr volume);
  /// Ends in saved() or failed(). The map has labels.
  void save(const SegmentMap& map, const QString& path);

 Q_SIGNALS:
  void segmented(const volumen::SegmentMap& map);
  void measured(const std::shared_ptr<const volumen::LabelMap>& labels,
                const volumen::LabelStatistics& statistics);
  void saved(const QString& path, const volumen::SegmentMap& map);
  void failed(const QString& sentence);

 private:
  JobLane segment_, measure_, save_;
};

}  // namespace volumen
