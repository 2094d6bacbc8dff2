#include "ui/controller/segment_edits.h"

#include <QLocale>
#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "results/segments/segment_maps.h"
#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "viewer/recipe/scissors.h"
#include "viewer/recipe/step_kinds.h"

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

QString whyNotCut(const Session& session, const SegmentCut& cut) {
  if (cut.onFrame) return tr("Segments cannot be cut on frames: show the series as slices.");
  const QString why = whyNotIn(session, cut.series);
  return why.isEmpty() ? whyNotChanged(session) : why;
}

bool isSeed(const Segment& segment) { return segment.visible && !segment.locked; }

// Seeds are ordered by number, which decides between paths of equal cost.
Result<SegmentMap> grownIn(SegmentMap map, const Volume& volume, const Mask& mask, GrowthRegion region,
                           const CancelToken& cancel) {
  StepsWanted wanted{{}, {}, true, {}};
  std::vector<std::string> with, locked;
  for (const Segment& segment : map.segments)
    if (isSeed(segment))
      wanted.numbers.push_back(segment.number);
    else
      locked.push_back(stepNameOf(segment.number));
  if (wanted.numbers.size() < 2)
    return Error{"Nothing was grown: seeds of at least two segments are needed, shown and not locked."};
  std::ranges::sort(wanted.numbers);
  for (const int number : wanted.numbers) with.push_back(stepNameOf(number));
  const std::string first = with.front();
  with.erase(with.begin());
  const std::string within = keptName(wanted, volume, mask, cancel),
                    where = region == GrowthRegion::everywhere ? "everywhere" : "about";
  wanted.steps.push_back({growFromSeedsStep,
                          first,
                          {{"with", with}, {"region", where}, {"within", within}, {"locked", locked}}});
  Result<SegmentMap> made = withStepsDone(std::move(map), wanted, volume, cancel);
  if (made || cancel.cancelled()) return made;
  return Error{"Nothing was grown: " + withoutStepName(made.message())};
}

QString whyNotGrown(const Session& session) {
  const QString why = whyNoSegments(session);
  if (!why.isEmpty()) return why;
  const SegmentMap* map = segmentsShown(session);
  if (map && std::ranges::count_if(map->segments, isSeed) >= 2) return {};
  return tr(
      "Paint into two or more segments first, what lies around included: those that are shown and not "
      "locked are the seeds.");
}

}  // namespace

Result<SegmentWork> cutOf(const Session& session, const SegmentOptions& options, const SegmentCut& cut) {
  if (const QString why = whyNotCut(session, cut); !why.isEmpty()) return Error{why.toStdString()};
  SegmentWork work =
      workShown(session, cut.lasso.inside ? tr("Cut segment inside") : tr("Cut segment outside"),
                tr("Cutting the segment"));
  const bool isDeep = !cut.inSlice || options.cutWithinMm <= 0;
  const double within = isDeep ? std::numeric_limits<double>::infinity() : options.cutWithinMm;
  work.makeAll = [lasso = cut.lasso, within, number = segmentShown(session)->number, volume = work.volume](
                     const SegmentMap& map, const CancelToken& cancel) {
    return withCut(map, number, lasso, within, *volume, cancel);
  };
  return work;
}

SegmentWork growthOf(const SeriesKey& series, VolumePtr volume, const Mask& mask, GrowthRegion region) {
  SegmentWork work;
  work.series = series;
  work.volume = volume;
  work.text = tr("Grow from seeds");
  work.doing = tr("Growing from seeds");
  work.makeAll = [volume = std::move(volume), mask, region](const SegmentMap& map,
                                                            const CancelToken& cancel) {
    return grownIn(map, *volume, mask, region, cancel);
  };
  return work;
}

Result<SegmentWork> growthOf(const Session& session, GrowthRegion region) {
  if (const QString why = whyNotGrown(session); !why.isEmpty()) return Error{why.toStdString()};
  const SeriesKey series = keyOf(session.series()->series);
  return growthOf(series, wholeVolume(session), session.maskOf(series), region);
}

SegmentWork moveOf(const Session& session, std::optional<int> map,
                   std::function<void(const QString& sentence)> told) {
  const SegmentMap& from = *segmentsShown(session);
  const Segment& segment = *segmentShown(session);
  const QString name = shownText(segment.label), where = map ? mapName(*map) : tr("a new map");
  const auto taken = std::make_shared<std::int64_t>(0);  // set on another thread when the work is done
  SegmentWork work = workShown(session, tr("Move %1 to %2").arg(name, where), tr("Moving a segment"));
  work.makeMaps = [source = from.number, number = segment.number, map, taken](
                      const std::vector<SegmentMap>& maps,
                      const CancelToken&) -> Result<std::vector<SegmentMap>> {
    Result<MovedSegment> moved = withSegmentMoved(maps, source, number, map);
    if (!moved) return moved.error();
    *taken = moved->taken;
    return std::move(moved->maps);
  };
  work.done = [name, where, taken, told = std::move(told)] {
    if (*taken > 0)
      told(tr("%1 took %2 voxels from other segments of %3.")
               .arg(name, QLocale().toString(qlonglong(*taken)), where));
  };
  return work;
}

}  // namespace volumen
