#include "results/segments/segments.h"

#include <algorithm>

#include "results/segments/region_colours.h"
#include "results/segments/segment_maps.h"
#include "results/segments/segment_record.h"
#include "results/text/text.h"

namespace volumen {

namespace {

constexpr int mostSegments = 255;

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

}  // namespace volumen
