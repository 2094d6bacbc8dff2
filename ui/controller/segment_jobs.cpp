#include "ui/controller/segment_jobs.h"

#include "io/export/seg_nrrd.h"
#include "viewer/segment/range.h"

namespace volumen {

SegmentJobs::SegmentJobs(Jobs& jobs, QObject* parent)
    : QObject(parent), segment_(&jobs), measure_(&jobs), save_(&jobs) {
  save_.keepToTheEnd();
}

SegmentJobs::~SegmentJobs() { save_.wait(); }

void SegmentJobs::segment(const SeriesKey& series, VolumePtr volume, const Segment& segment) {
  segment_.giveUpAll();
  segment_.run(
      tr("Segmenting"),
      [series, volume, segment](const Job&) {
        return SegmentMap{
            series, {segment}, std::make_shared<const LabelMap>(labelRange(*volume, *segment.range)), {}};
      },
      [this](const SegmentMap& made) { Q_EMIT segmented(made); });
}

void SegmentJobs::measure(const std::shared_ptr<const LabelMap>& labels, VolumePtr volume) {
  measure_.giveUpAll();
  measure_.run(
      tr("Measuring the segment"), [labels, volume](const Job&) { return labelStatistics(*labels, *volume); },
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
