#include "ui/controller/segment_jobs.h"

#include <new>

#include "io/export/seg_nrrd.h"

namespace volumen {

namespace {

Result<std::shared_ptr<const LabelMap>> labelsOf(const Volume& volume, const Mask& mask, ValueRange range,
                                                 const CancelToken& cancel) try {
  const BitMask voxels = keptVoxelsInRange(volume, range, mask, cancel);
  return std::make_shared<const LabelMap>(withLabel(LabelMap(volume.geometry()), 1, voxels));
} catch (const std::bad_alloc&) {
  return Error{"Nothing was segmented: there is not enough memory."};
}

}  // namespace

SegmentJobs::SegmentJobs(Jobs& jobs, QObject* parent)
    : QObject(parent), segment_(&jobs), measure_(&jobs), save_(&jobs) {
  save_.keepToTheEnd();
}

SegmentJobs::~SegmentJobs() { save_.wait(); }

void SegmentJobs::segment(const SeriesKey& series, VolumePtr volume, const Mask& mask,
                          const Segment& segment) {
  segment_.giveUpAll();
  segment_.run(
      tr("Segmenting"),
      [series, volume, mask, segment](const Job& job) -> Result<SegmentMap> {
        const auto labels = labelsOf(*volume, mask, *segment.range, job.cancel());
        if (!labels) return labels.error();
        return SegmentMap{series, {segment}, *labels, {}};
      },
      [this](const Result<SegmentMap>& made) {
        if (made)
          Q_EMIT segmented(*made);
        else
          Q_EMIT failed(QString::fromStdString(made.message()));
      });
}

void SegmentJobs::measure(const std::shared_ptr<const LabelMap>& labels, int number, VolumePtr volume) {
  measure_.giveUpAll();
  measure_.run(
      tr("Measuring the segment"),
      [labels, number, volume](const Job&) {
        return labelStatistics(*labels, *volume, std::uint8_t(number));
      },
      [this, labels](const LabelStatistics& statistics) { Q_EMIT measured(labels, statistics); });
}

void SegmentJobs::save(const SegmentMap& map, const QString& path) {
  save_.run(
      tr("Saving the segment"),
      [map, path](const Job&) { return writeSegNrrd(*map.labels, map.segments, path.toStdString()); },
      [this, map, path](const Status& status) {
        if (status)
          Q_EMIT saved(path, map);
        else
          Q_EMIT failed(QString::fromStdString(status.message()));
      });
}

}  // namespace volumen
