#include "ui/controller/segment_preview.h"

#include <new>

#include "ui/workspace/segments.h"

namespace volumen {

SegmentPreview::SegmentPreview(Session& session, Jobs& jobs, QObject* parent)
    : QObject(parent), session_(session), lane_(&jobs) {}

void SegmentPreview::show(const SegmentWork& work) {
  lane_.giveUpAll();
  base_.reset();
  const SegmentMap base = segmentMapOn(session_.workspace(), work.series, work.volume->geometry());
  lane_.run(
      JobName(work.doing),
      [work, base](const Job& job) -> Result<SegmentMap> {
        try {
          return work.makeAll(base, job.cancel());
        } catch (const std::bad_alloc&) {
          return Error{"There is not enough memory for a preview."};
        }
      },
      [this, base](const Result<SegmentMap>& made) { take(base, made); },
      [this] {
        clear();
        Q_EMIT failed({});
      });
}

void SegmentPreview::take(const SegmentMap& base, const Result<SegmentMap>& made) {
  if (!made) {
    clear();
    return Q_EMIT failed(QString::fromStdString(made.message()));
  }
  base_ = base;
  made_ = *made;
  Q_EMIT changed(made_);
}

void SegmentPreview::clear() {
  lane_.giveUpAll();
  base_.reset();
  if (made_.has_value()) {
    made_.reset();
    Q_EMIT changed({});
  }
}

SegmentWork SegmentPreview::withMade(SegmentWork work) const {
  if (!base_) return work;
  work.makeAll = [base = *base_, made = *made_, makeAll = work.makeAll](
                     const SegmentMap& map, const CancelToken& cancel) -> Result<SegmentMap> {
    if (map == base) return made;
    return makeAll(map, cancel);
  };
  return work;
}

}  // namespace volumen
