#pragma once

#include <QObject>
#include <QThreadPool>
#include <memory>

#include "ui/workspace/range_segment.h"

namespace volumen {

/// Segments and saves on a worker thread.
class Segmenter : public QObject {
  Q_OBJECT
 public:
  explicit Segmenter(QObject* parent = nullptr);
  ~Segmenter() override;

  /// Only the result of the latest request is told.
  void segment(VolumePtr volume, ValueRange range);
  void save(std::shared_ptr<const RangeSegment> segmentation, const SegmentFile& file);

 Q_SIGNALS:
  void segmented(const std::shared_ptr<const volumen::RangeSegment>& segmentation);
  void saved(const QString& path, const std::shared_ptr<const volumen::RangeSegment>& segmentation);
  void failed(const QString& sentence);

 private:
  QThreadPool pool_;
  int latest_ = 0;
};

}  // namespace volumen
