#pragma once

#include <memory>

#include "ui/document/job_lane.h"
#include "ui/workspace/range_segment.h"

namespace volumen {

/// Segments and saves; each a job.
class Segmenter : public QObject {
  Q_OBJECT
 public:
  explicit Segmenter(Jobs& jobs, QObject* parent = nullptr);
  /// Waits for what is being written.
  ~Segmenter() override;

  /// Gives up what was to be segmented before.
  void segment(VolumePtr volume, ValueRange range);
  void save(std::shared_ptr<const RangeSegment> segmentation, const SegmentFile& file);

 Q_SIGNALS:
  void segmented(const std::shared_ptr<const volumen::RangeSegment>& segmentation);
  void saved(const QString& path, const std::shared_ptr<const volumen::RangeSegment>& segmentation);
  void failed(const QString& sentence);

 private:
  JobLane segment_, save_;
};

}  // namespace volumen
