#include "ui/controller/segmenter.h"

#include "io/export/seg_nrrd.h"
#include "viewer/segment/range.h"

namespace volumen {

namespace {

std::shared_ptr<const RangeSegment> rangeSegment(const VolumePtr& volume, ValueRange range) {
  auto made = std::make_shared<RangeSegment>();
  made->volume = volume;
  made->range = range;
  made->map = labelRange(*volume, range);
  made->statistics = labelStatistics(made->map, *volume);
  return made;
}

}  // namespace

Segmenter::Segmenter(Jobs& jobs, QObject* parent) : QObject(parent), segment_(&jobs), save_(&jobs) {
  save_.keepToTheEnd();
}

Segmenter::~Segmenter() { save_.wait(); }

void Segmenter::segment(VolumePtr volume, ValueRange range) {
  segment_.giveUpAll();
  segment_.run(
      tr("Segmenting"), [volume, range](const Job&) { return rangeSegment(volume, range); },
      [this](const std::shared_ptr<const RangeSegment>& made) { Q_EMIT segmented(made); });
}

void Segmenter::save(std::shared_ptr<const RangeSegment> segmentation, const SegmentFile& file) {
  save_.run(
      tr("Saving the segment"),
      [segmentation, file](const Job&) {
        return writeSegNrrd(segmentation->map, file.name.toStdString(), file.colour, file.path.toStdString());
      },
      [this, segmentation, path = file.path](const Status& status) {
        if (status)
          Q_EMIT saved(path, segmentation);
        else
          Q_EMIT failed(QString::fromStdString(status.message()));
      });
}

}  // namespace volumen
