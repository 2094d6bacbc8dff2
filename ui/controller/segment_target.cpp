#include "ui/controller/segment_target.h"

#include <algorithm>

#include "results/segments/segment_maps.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "ui/workspace/series_segments.h"

namespace volumen {

QString whyNoSegments(const Session& session) {
  const LoadedSeriesPtr& series = session.series();
  if (!series) return tr("Open a series first.");
  if (series->series.curved)
    return tr("Volumes along a curve are not the patient's: segment the series that the curve was drawn in.");
  if (missesSegments(session.workspace(), keyOf(series->series)))
    return tr("The segments of this series were not found with its session: put their file beside it.");
  return {};
}

const SegmentMap* segmentsShown(const Session& session) {
  if (!whyNoSegments(session).isEmpty()) return nullptr;
  const LoadedSeriesPtr& series = session.series();
  const SegmentMap* map = segmentMapOf(session.workspace(), keyOf(series->series));
  return map && isOn(*map, series->volume->geometry()) ? map : nullptr;
}

std::vector<const SegmentMap*> allSegmentsShown(const Session& session) {
  if (!segmentsShown(session)) return {};
  const LoadedSeriesPtr& series = session.series();
  std::vector<const SegmentMap*> maps = segmentMapsOf(session.workspace(), keyOf(series->series));
  std::erase_if(maps, [&](const SegmentMap* map) { return !isOn(*map, series->volume->geometry()); });
  return maps;
}

std::vector<SegmentMap> copiesOf(const std::vector<const SegmentMap*>& maps) {
  std::vector<SegmentMap> copies;
  for (const SegmentMap* map : maps) copies.push_back(*map);
  return copies;
}

const Segment* segmentShown(const Session& session) {
  const SegmentMap* map = segmentsShown(session);
  return map ? currentSegment(*map) : nullptr;
}

const Segment* otherSegmentShown(const Session& session, int number) {
  const SegmentMap* map = segmentsShown(session);
  if (!map) return nullptr;
  const auto isOther = [current = currentSegment(*map)](const Segment& segment) {
    return &segment != current;
  };
  auto found = std::ranges::find(map->segments, number, &Segment::number);
  if (found == map->segments.end() || !isOther(*found)) found = std::ranges::find_if(map->segments, isOther);
  return found == map->segments.end() ? nullptr : &*found;
}

QString isOfOtherSeries() {
  return tr("The panel Segments is about another series: click into a view of that one.");
}

QString whyNotIn(const Session& session, const SeriesKey& series) {
  const QString why = whyNoSegments(session);
  return why.isEmpty() && series != keyOf(session.series()->series) ? isOfOtherSeries() : why;
}

QString noOtherSegment(const Session& session) {
  return allSegmentsShown(session).size() < 2
             ? tr("There is no other segment.")
             : tr("There is no other segment in %1.").arg(mapName(segmentsShown(session)->number));
}

QString whyNotChanged(const Session& session) {
  const QString why = whyNoSegments(session);
  if (!why.isEmpty()) return why;
  const Segment* segment = segmentShown(session);
  if (!segment) return tr("Make or add a segment first.");
  return segment->locked ? tr("%1 is locked: unlock it first.").arg(shownText(segment->label)) : QString();
}

VolumePtr wholeVolume(const Session& session) {
  const LoadedSeriesPtr whole = session.seriesWith(keyOf(session.series()->series), {});
  return (whole ? whole : session.series())->volume;
}

}  // namespace volumen
