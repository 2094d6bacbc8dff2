#include "ui/controller/segment_editing.h"

#include <utility>

#include "results/segments/segments.h"
#include "results/text/text.h"
#include "ui/controller/segment_edits.h"
#include "ui/controller/segment_target.h"
#include "ui/workspace/series_segments.h"
#include "ui/workspace/when_changed.h"

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

SegmentEditing::SegmentEditing(Session& session, Jobs& jobs)
    : session_(session), painter_(session), jobs_(session, painter_, jobs), preview_(&jobs) {
  connect(&painter_, &SegmentPainter::answered, this, &SegmentEditing::answered);
  connect(&jobs_, &SegmentJobs::answered, this, &SegmentEditing::answered);
  connect(&jobs_, &SegmentJobs::ended, this, &SegmentEditing::follow);
  connect(&session_, &Session::changed, this, [this](const SessionState& before, const SessionState& after) {
    if (before.series != after.series) follow();
  });
  whenChanged(session_, this, &SegmentEditing::follow, &Workspace::segmentMaps);
}

void SegmentEditing::choose(const std::function<void(SegmentOptions&)>& change) {
  const SegmentOptions before = options_;
  change(options_);
  if (options_ == before) return;
  const bool isOtherRegion = options_.previewsGrowth && before.growthRegion != options_.growthRegion;
  if (before.previewsGrowth != options_.previewsGrowth || isOtherRegion) showGrowth();
  Q_EMIT optionsChanged();
}

void SegmentEditing::paint(SegmentStroke stroke) {
  stroke.erases = stroke.erases || options_.erases;
  painter_.paint(stroke, options_);
}

void SegmentEditing::paintAll(SegmentStroke stroke) {
  paint(stroke);
  stroke.phase = SegmentStroke::Phase::ends;
  paint(stroke);
}

void SegmentEditing::change(const Result<SegmentWork>& work) {
  if (!work) {
    Q_EMIT answered({SegmentAnswer::Kind::refused, shownText(work.message())});
    return endPreview();
  }
  isHeld_ = isHeld_ || isOfTool_;
  jobs_.change(*work);
}

void SegmentEditing::preview(const Result<SegmentWork>& work) {
  if (!work) return endPreview();
  seeds_.reset();
  isOfTool_ = true;
  show(*work);
}

void SegmentEditing::endPreview() {
  if (isOfTool_) showGrowth();
}

void SegmentEditing::grow() {
  Result<SegmentWork> work = growthOf(session_, options_.growthRegion);
  if (!work) return change(work);
  isHeld_ = true;
  seeds_.reset();
  stopGrowthPreview();
  if (made_ && !isLate_)
    work->makeAll = [done = *made_, makeAll = work->makeAll](
                        const SegmentMap& map, const CancelToken& cancel) -> Result<SegmentMap> {
      if (map == done.base) return done.made;
      return makeAll(map, cancel);
    };
  jobs_.change(*work);
}

// Previews growth anew once the seeds have changed. Ends the preview of a change that was made.
void SegmentEditing::follow() {
  const SegmentMap* map = segmentsShown(session_);
  const bool isOther = !map || (seeds_ && seeds_->series != map->series);
  if (isOther || !growthOf(session_, options_.growthRegion)) stopGrowthPreview();
  const bool isChanged =
      seeds_ && (!map || map->labels != seeds_->labels || map->segments != seeds_->segments);
  if (std::exchange(isHeld_, false) || isChanged) showGrowth();
}

void SegmentEditing::showGrowth() {
  seeds_.reset();
  isOfTool_ = false;
  const Result<SegmentWork> work = growthOf(session_, options_.growthRegion);
  if (!options_.previewsGrowth || !work) return clear();
  seeds_ = *segmentsShown(session_);
  show(*work);
}

// Switches off the option that growth is previewed. The preview on screen stays until clear().
void SegmentEditing::stopGrowthPreview() {
  if (std::exchange(options_.previewsGrowth, false)) Q_EMIT optionsChanged();
}

// Only the latest request counts. The preview before stays until this one is ready.
void SegmentEditing::show(const SegmentWork& work) {
  preview_.giveUpAll();
  isLate_ = true;
  preview_.run(
      JobName(work.doing),
      [work, base = segmentMapOn(session_.workspace(), work.series, work.volume->geometry())](
          const Job& job) -> Result<Made> {
        const Result<SegmentMap> made = work.makeAll(base, job.cancel());
        if (!made) return made.error();
        return Made{base, *made, changedSegments(base, *made)};
      },
      [this](const Result<Made>& made) {
        if (!made) return fail(shownText(made.message()));
        made_ = *made;
        isLate_ = false;
        Q_EMIT previewChanged();
      },
      [this] { fail({}); });
}

// The sentence is empty if the user cancelled. A tool's failure is answered once it makes the change.
void SegmentEditing::fail(const QString& sentence) {
  clear();
  if (!std::exchange(seeds_, std::nullopt)) return;
  stopGrowthPreview();
  if (!sentence.isEmpty()) Q_EMIT answered({SegmentAnswer::Kind::failed, sentence});
}

void SegmentEditing::clear() {
  preview_.giveUpAll();
  if (std::exchange(made_, std::nullopt)) Q_EMIT previewChanged();
}

}  // namespace volumen
