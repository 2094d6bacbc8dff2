#include "ui/controller/segmenter.h"

#include "io/export/seg_nrrd.h"
#include "viewer/segment/range.h"

namespace volumen {

Segmenter::Segmenter(QObject* parent) : QObject(parent) { pool_.setMaxThreadCount(1); }

Segmenter::~Segmenter() {
  pool_.clear();
  pool_.waitForDone();
}

void Segmenter::segment(VolumePtr volume, ValueRange range) {
  pool_.start([this, volume, range, number = ++latest_] {
    auto made = std::make_shared<RangeSegment>();
    made->volume = volume;
    made->range = range;
    made->map = labelRange(*volume, range);
    made->statistics = labelStatistics(made->map, *volume);
    QMetaObject::invokeMethod(
        this,
        [this, made, number] {
          if (number == latest_) Q_EMIT segmented(made);
        },
        Qt::QueuedConnection);
  });
}

void Segmenter::save(std::shared_ptr<const RangeSegment> segmentation, const SegmentFile& file) {
  pool_.start([this, segmentation, file] {
    const Status status =
        writeSegNrrd(segmentation->map, file.name.toStdString(), file.colour, file.path.toStdString());
    const QString sentence = status ? QString() : QString::fromStdString(status.message());
    QMetaObject::invokeMethod(
        this,
        [this, sentence, path = file.path, segmentation] {
          if (sentence.isEmpty())
            Q_EMIT saved(path, segmentation);
          else
            Q_EMIT failed(sentence);
        },
        Qt::QueuedConnection);
  });
}

}  // namespace volumen
