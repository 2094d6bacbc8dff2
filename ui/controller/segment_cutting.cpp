#include "ui/controller/segment_cutting.h"

#include <limits>

#include "ui/controller/segment_target.h"
#include "ui/workspace/segment_record.h"
#include "ui/workspace/segments.h"
#include "ui/workspace/text.h"
#include "viewer/recipe/scissors.h"

namespace volumen {

namespace {

// The segment may have been locked or removed since the request.
Result<SegmentMap> withCut(const SegmentMap& map, int number, const Lasso& lasso, double withinMm,
                           const Volume& volume, const CancelToken& cancel) {
  const Segment* segment = findSegment(map, number);
  if (!segment || segment->locked) return Error{"The segment to cut was locked or removed meanwhile."};
  Result<SegmentMap> cut =
      withStepsDone(map, {{scissorsStep(stepNameOf(number), lasso, withinMm)}, {number}}, volume, cancel);
  if (cut && *cut->labels == *map.labels)
    return Error{"Nothing of the current segment was cut away: draw around a part of it."};
  return cut;
}

}  // namespace

QString whyNotCut(const Session& session, const SegmentCut& cut) {
  if (cut.onFrame) return tr("Segments cannot be cut on frames: show the series as slices.");
  const QString why = whyNoSegments(session);
  if (!why.isEmpty()) return why;
  if (cut.series != keyOf(session.series()->series))
    return tr("The panel Segments is about another series: click into a view of that one.");
  return whyNotChanged(session);
}

SegmentWork workOf(const SegmentCut& cut, double withinMm, const Session& session) {
  SegmentWork work;
  work.series = cut.series;
  work.volume = wholeVolume(session);
  work.text = cut.lasso.inside ? tr("Cut segment inside") : tr("Cut segment outside");
  work.doing = tr("Cutting the segment");
  const double within = cut.inSlice ? withinMm : std::numeric_limits<double>::infinity();
  work.makeAll = [lasso = cut.lasso, within, number = segmentShown(session)->number, volume = work.volume](
                     const SegmentMap& map, const CancelToken& cancel) {
    return withCut(map, number, lasso, within, *volume, cancel);
  };
  return work;
}

}  // namespace volumen
