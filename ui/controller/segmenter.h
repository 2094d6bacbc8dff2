#pragma once

#include <QObject>
#include <QThreadPool>
#include <memory>

#include "viewer/segment/label_map.h"

namespace volumen {

/// The voxels of a value range and what they amount to.
struct Segmentation {
  VolumePtr volume;
  ValueRange range;
  LabelMap map;
  LabelStatistics statistics;
};

/// Segments and saves on a worker thread.
class Segmenter : public QObject {
  Q_OBJECT
 public:
  explicit Segmenter(QObject* parent = nullptr);
  ~Segmenter() override;

  /// Only the result of the latest request is told.
  void segment(VolumePtr volume, ValueRange range);
  /// Writes a .seg.nrrd file; `colour` RGB 0..1.
  void save(std::shared_ptr<const Segmentation> segmentation, const QString& name, glm::dvec3 colour,
            const QString& path);

 Q_SIGNALS:
  void segmented(const std::shared_ptr<const volumen::Segmentation>& segmentation);
  void saved(const QString& path);
  void failed(const QString& sentence);

 private:
  QThreadPool pool_;
  int latest_ = 0;
};

}  // namespace volumen
