#include "ui/controller/segment_painter.h"

#include <utility>

#include "results/segments/segments.h"
#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "ui/workspace/segment_change_text.h"
#include "ui/workspace/series_segments.h"

namespace volumen {

namespace {

PaintRules rulesOf(const SegmentMap& map, int number, bool erases, const SegmentOptions& limits,
                   const VolumePtr& volume) {
  using enum PaintBeside;
  PaintRules rules{.label = std::uint8_t(number), .erases = erases, .volume = volume};
  if (limits.paintsInRange) rules.range = limits.range;
  if (erases) return rules;  // erased voxels belong to the segment and to no other
  rules.kept = lockedNumbers(map);
  if (limits.other == 0) return rules;
  const auto other = std::uint8_t(limits.other);
  if (limits.beside == outside) rules.kept.push_back(other);
  if (limits.beside != inside) return rules;
  for (int label = 0; label < 256; ++label)
    if (label != other) rules.kept.push_back(std::uint8_t(label));
  return rules;
}

}  // namespace

QString SegmentPainter::whyNot(const SegmentStroke& stroke) const {
  if (stroke.onFrame) return tr("Frames cannot be painted on: show the series as slices.");
  if (const QString why = whyNotIn(session_, stroke.series); !why.isEmpty()) return why;
  const Segment* segment = segmentShown(session_);
  if (segment && !segment->visible && !segment->locked)
    return tr("%1 is hidden: tick it in the list of segments first.").arg(shownText(segment->label));
  return stroke.erases || segment ? whyNotChanged(session_) : QString();
}

void SegmentPainter::paint(const SegmentStroke& stroke, const SegmentOptions& options) {
  using enum SegmentStroke::Phase;
  if (stroke.phase == ends) return end();
  if (stroke.phase == begins) {
    end();  // in case the end of the last stroke was not reported
    const QString why = whyNot(stroke);
    if (!why.isEmpty()) return Q_EMIT answered({SegmentAnswer::Kind::refused, why});
    const Segment* segment = segmentShown(session_);
    const VolumePtr& volume = session_.series()->volume;
    const SegmentMap map = segmentMapOn(session_.workspace(), stroke.series, volume->geometry());
    target_ = Target{volume, map.number, segment ? segment->number : 0, options, map};
    const Segment* other = otherSegmentShown(session_, options.other);
    target_->limits.other = other ? other->number : 0;
    session_.endGesture();
  }
  if (target_ && !stroke.spans.empty()) add(stroke);
}

void SegmentPainter::end() {
  if (!target_) return;
  const SegmentMap before = std::exchange(target_, {})->before;
  const SegmentMap* after = segmentMapOf(session_.workspace(), before.series, before.number);
  session_.endGesture();
  const QString said = after && after->labels ? changeText(before, *after) : QString();
  if (!said.isEmpty()) Q_EMIT answered({SegmentAnswer::Kind::done, said});
  Q_EMIT ended();
}

void SegmentPainter::add(const SegmentStroke& stroke) {
  Workspace after = session_.workspace();
  if (!after.series.contains(stroke.series)) return;
  const VoxelGeometry& grid = target_->volume->geometry();
  if (target_->number == 0) {
    after = withNewSegment(std::move(after), stroke.series, grid, {}, target_->map);
    target_->number = segmentMapOf(after, stroke.series, target_->map)->current;
  }
  SegmentMap map = segmentMapOn(after, stroke.series, grid, target_->map);
  const Segment* segment = findSegment(map, target_->number);
  if (!segment || segment->locked) return;
  map.labels = std::make_shared<const LabelMap>(
      painted(*map.labels, stroke.spans,
              rulesOf(map, target_->number, stroke.erases, target_->limits, target_->volume)));
  const QString text = stroke.erases ? tr("Erase") : tr("Paint");
  session_.change(text, withSegmentMap(std::move(after), map), text);
}

}  // namespace volumen
