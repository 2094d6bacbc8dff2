#include "ui/workspace/series_segments.h"

#include <algorithm>

#include "results/segments/segment_maps.h"
#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "results/text/text.h"

namespace volumen {

namespace {

// Returns the first free name "Segment N" from this number on.
std::string freshName(const std::vector<SegmentMap>& maps, int number) {
  while (true) {
    const std::string name = tr("Segment %1").arg(number++).toStdString();
    if (freeName(maps, name) == name) return name;
  }
}

SegmentMap* editMap(Workspace& workspace, const SeriesKey& series) {
  for (std::size_t n = 0; n < workspace.segmentMaps.size(); ++n)
    if (workspace.segmentMaps[n].series == series) return &workspace.segmentMaps.edit(n);
  return nullptr;
}

}  // namespace

bool missesSegments(const Workspace& workspace, const SeriesKey& series) {
  return std::ranges::any_of(segmentMapsOf(workspace, series),
                             [](const SegmentMap* map) { return map->missing.has_value(); });
}

Workspace withMapWorkedOn(Workspace workspace, const SeriesKey& series, int number) {
  SharedList<SegmentMap>& maps = workspace.segmentMaps;
  const auto isOfIt = [&](const SegmentMap& map) { return map.series == series; };
  const auto isIt = [&](const SegmentMap& map) { return isOfIt(map) && map.number == number; };
  const auto first = std::size_t(std::ranges::find_if(maps, isOfIt) - maps.begin());
  const auto chosen = std::size_t(std::ranges::find_if(maps, isIt) - maps.begin());
  if (chosen == maps.size() || chosen == first) return workspace;
  const SegmentMap before = maps[first];
  maps.edit(first) = SegmentMap(maps[chosen]);
  maps.edit(chosen) = before;
  return workspace;
}

SegmentMap asMapOf(const Workspace& workspace, const SeriesKey& series, SegmentMap map) {
  map.series = series;
  while (segmentMapOf(workspace, series, map.number)) ++map.number;
  if (const SegmentMap* there = segmentMapOf(workspace, series))
    map.in3d = there->in3d, map.tissue = there->tissue;
  return map;
}

std::vector<SegmentMap> segmentMapsOn(const Workspace& workspace, const SeriesKey& series,
                                      const VoxelGeometry& grid) {
  std::vector<SegmentMap> maps{segmentMapOn(workspace, series, grid)};
  for (const SegmentMap* map : segmentMapsOf(workspace, series))
    if (map->number != maps.front().number && isOn(*map, grid)) maps.push_back(*map);
  return maps;
}

Workspace withSegmentMapsOf(Workspace workspace, const std::vector<SegmentMap>& maps) {
  for (const SegmentMap& map : maps) workspace = withSegmentMap(std::move(workspace), map);
  return maps.empty() ? workspace
                      : withMapWorkedOn(std::move(workspace), maps.front().series, maps.front().number);
}

Workspace withSegmentChanged(Workspace workspace, const SeriesKey& series, int number,
                             const std::function<void(Segment&)>& change) {
  const SegmentMap* there = segmentMapOf(workspace, series);
  if (!there || !findSegment(*there, number)) return workspace;
  Segment& segment = *std::ranges::find(editMap(workspace, series)->segments, number, &Segment::number);
  change(segment);
  segment.number = number;
  return workspace;
}

Workspace withCurrentSegment(Workspace workspace, const SeriesKey& series, int number) {
  const SegmentMap* there = segmentMapOf(workspace, series);
  if (there && findSegment(*there, number)) editMap(workspace, series)->current = number;
  return workspace;
}

Workspace withSegmentsIn3d(Workspace workspace, const SeriesKey& series, bool in3d) {
  workspace.segmentMaps.editIf([&](const SegmentMap& map) { return map.series == series; },
                               [&](SegmentMap& map) { map.in3d = in3d; });
  return workspace;
}

Workspace withTissueShown(Workspace workspace, const SeriesKey& series, const TissueShown& tissue) {
  workspace.segmentMaps.editIf([&](const SegmentMap& map) { return map.series == series; },
                               [&](SegmentMap& map) { map.tissue = tissue; });
  return workspace;
}

Workspace withNewSegment(Workspace workspace, const SeriesKey& series, const VoxelGeometry& grid,
                         Segment segment, std::optional<int> number) {
  SegmentMap map = segmentMapOn(workspace, series, grid, number);
  if (!freeNumber(map) || !workspace.series.contains(series)) return workspace;
  const SegmentMap before = map;
  std::vector<SegmentMap> maps{map};
  for (const SegmentMap* other : segmentMapsOf(workspace, series)) maps.push_back(*other);
  if (segment.label.empty()) segment.label = freshName(maps, *freeNumber(map));
  map = withNewOnesApart(before, withSegmentAdded(std::move(map), std::move(segment)), maps);
  const std::string made = stepNameOf(map.current);
  return withSegmentMap(std::move(workspace), withRecorded(std::move(map), {{"empty", made}}));
}

SegmentMap segmentMapOn(const Workspace& workspace, const SeriesKey& series, const VoxelGeometry& grid,
                        std::optional<int> number) {
  const SegmentMap* worked = segmentMapOf(workspace, series);
  const SegmentMap* map = number ? segmentMapOf(workspace, series, *number) : worked;
  if (map && isOn(*map, grid)) return *map;
  SegmentMap made{series, {}, std::make_shared<const LabelMap>(grid), {}};
  if (worked && isOn(*worked, grid)) made.in3d = worked->in3d, made.tissue = worked->tissue;
  made.number = number ? *number : worked ? worked->number : 0;
  return made;
}

}  // namespace volumen
