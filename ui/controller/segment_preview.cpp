#include "ui/controller/segment_preview.h"

#include <new>
#include <utility>

#include "ui/workspace/segments.h"

namespace volumen {

namespace {

// Hides unchanged segments, which are visible already.
SegmentMap changedSegments(const SegmentMap& base, SegmentMap made) {
  for (Segment& segment : made.segments) {
    const auto label = std::uint8_t(segment.number);
    const bool isSame =
        findSegment(base, segment.number) &&
        (made.labels == base.labels || maskOf(*made.labels, label) == maskOf(*base.labels, label));
    segment.visible = segment.visible && !isSame;
  }
  return made;
}

}  // namespace

SegmentPreview::SegmentPreview(Session& session, Jobs& jobs, QObject* parent)
    : QObject(parent), session_(session), lane_(&jobs) {}

void SegmentPreview::show(const SegmentWork& work) {
  lane_.giveUpAll();
  isLate_ = true;
  lane_.run(
      JobName(work.doing),
      [work, base = segmentMapOn(session_.workspace(), work.series, work.volume->geometry())](
          const Job& job) -> Result<Made> {
        const Result<SegmentMap> made = work.makeAll(base, job.cancel());
        if (!made) return made.error();
        return Made{base, *made, changedSegments(base, *made)};
      },
      [this](const Result<Made>& made) {
        if (!made) return fail(QString::fromStdString(made.message()));
        made_ = *made;
        isLate_ = false;
        Q_EMIT changed(made_->shown);
      },
      [this] { fail({}); });
}

void SegmentPreview::fail(const QString& sentence) {
  clear();
  Q_EMIT failed(sentence);
}

void SegmentPreview::clear() {
  lane_.giveUpAll();
  if (std::exchange(made_, std::nullopt)) Q_EMIT changed({});
}

SegmentWork SegmentPreview::withMade(SegmentWork work) const {
  if (!made_ || isLate_) return work;
  work.makeAll = [base = made_->base, made = made_->made, makeAll = work.makeAll](
                     const SegmentMap& map, const CancelToken& cancel) -> Result<SegmentMap> {
    if (map == base) return made;
    return makeAll(map, cancel);
  };
  return work;
}

}  // namespace volumen
