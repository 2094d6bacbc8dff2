#include "ui/workspace/segments.h"

#include <algorithm>

#include "ui/workspace/region_colours.h"
#include "ui/workspace/segment_maps.h"
#include "ui/workspace/segment_record.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

constexpr int mostSegments = 255;

Segment* editSegment(SegmentMap& map, int number) {
  const auto found = std::ranges::find(map.segments, number, &Segment::number);
  return found == map.segments.end() ? nullptr : &*found;
}

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

const Segment* findSegment(const SegmentMap& map, int number) {
  const auto found = std::ranges::find(map.segments, number, &Segment::number);
  return found == map.segments.end() ? nullptr : &*found;
}

const Segment* currentSegment(const SegmentMap& map) {
  if (const Segment* chosen = findSegment(map, map.current)) return chosen;
  return map.segments.empty() ? nullptr : &map.segments.front();
}

std::optional<int> freeNumber(const SegmentMap& map) {
  for (int number = 1; number <= mostSegments; ++number)
    if (!findSegment(map, number)) return number;
  return {};
}

std::string freeName(const SegmentMap& map, const std::string& wanted) {
  return freeName(std::span(&map, 1), wanted);
}

glm::u8vec3 colourOfNumber(int number) {
  const QColor colour = regionColour({}, number);
  return {colour.red(), colour.green(), colour.blue()};
}

std::vector<std::uint8_t> lockedNumbers(const SegmentMap& map) {
  std::vector<std::uint8_t> locked;
  for (const Segment& segment : map.segments)
    if (segment.locked) locked.push_back(std::uint8_t(segment.number));
  return locked;
}

bool isOn(const SegmentMap& map, const VoxelGeometry& grid) {
  return map.labels && map.labels->geometry() == grid;
}

SegmentMap withMask(SegmentMap map, int number, const BitMask& mask) {
  const Segment* segment = findSegment(map, number);
  if (!segment || segment->locked) return map;
  map.labels = std::make_shared<const LabelMap>(
      withLabel(*map.labels, std::uint8_t(number), mask, lockedNumbers(map)));
  return map;
}

SegmentMap withoutSegment(SegmentMap map, int number) {
  const Segment* segment = findSegment(map, number);
  if (!segment || segment->locked) return map;
  map = withMask(std::move(map), number, BitMask(map.labels->geometry()));
  const auto gone = std::ranges::find(map.segments, number, &Segment::number);
  map.steps = stepsWithout(map, number);
  const auto before = gone == map.segments.begin() ? gone + 1 : gone - 1;
  map.current = before == map.segments.end() ? 0 : before->number;
  map.segments.erase(gone);
  return map;
}

SegmentMap withSegment(SegmentMap map, Segment segment) {
  if (!segment.colour) segment.colour = freeColour(std::span(&map, 1), map.number, segment.number);
  map.current = segment.number;
  map.segments.push_back(std::move(segment));
  return map;
}

SegmentMap withSegmentAdded(SegmentMap map, Segment segment) {
  const std::optional<int> number = freeNumber(map);
  if (!number) return map;
  const bool isFree =
      segment.number >= 1 && segment.number <= mostSegments && !findSegment(map, segment.number);
  if (!isFree) segment.number = *number;
  if (segment.label.empty()) segment.label = tr("Segment %1").arg(segment.number).toStdString();
  segment.label = freeName(map, segment.label);
  return withSegment(std::move(map), std::move(segment));
}

Workspace withSegmentChanged(Workspace workspace, const SeriesKey& series, int number,
                             const std::function<void(Segment&)>& change) {
  const SegmentMap* there = segmentMapOf(workspace, series);
  if (!there || !findSegment(*there, number)) return workspace;
  Segment* segment = editSegment(*editMap(workspace, series), number);
  change(*segment);
  segment->number = number;
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
