#include "results/segments/segment_maps.h"

#include <algorithm>
#include <array>
#include <utility>

#include "results/segments/segment_record.h"
#include "results/segments/segments.h"
#include "results/text/text.h"
#include "viewer/segment/added_labels.h"
#include "viewer/segment/names_and_colours.h"
#include "viewer/volume/free_name.h"

namespace volumen {

namespace {

bool isCalled(const SegmentMap& map, const std::string& name) {
  return std::ranges::find(map.segments, name, &Segment::label) != map.segments.end();
}

// Returns an empty map that is shown as the others are.
SegmentMap furtherMap(const std::vector<SegmentMap>& maps) {
  SegmentMap made = maps.front();
  made.segments.clear();
  made.steps.clear();
  made.current = 0;
  made.labels = std::make_shared<const LabelMap>(maps.front().labels->geometry());
  for (made.number = 0; std::ranges::find(maps, made.number, &SegmentMap::number) != maps.end();)
    ++made.number;
  return made;
}

bool isColour(std::span<const SegmentMap> maps, glm::u8vec3 colour) {
  const auto isOf = [&](const Segment& s) { return s.colour.value_or(colourOfNumber(s.number)) == colour; };
  return std::ranges::any_of(maps,
                             [&](const SegmentMap& map) { return std::ranges::any_of(map.segments, isOf); });
}

// Gives new segments names that no other segment of the series has.
SegmentMap withNamesApart(const SegmentMap& before, SegmentMap after,
                          const std::vector<SegmentMap>& ofSeries) {
  const auto isTaken = [&](const std::string& name, const Segment& own) {
    return std::ranges::any_of(
               ofSeries,
               [&](const SegmentMap& map) { return map.number != after.number && isCalled(map, name); }) ||
           std::ranges::any_of(after.segments, [&](const Segment& other) {
             return other.number != own.number && other.label == name;
           });
  };
  for (Segment& segment : after.segments)
    if (!findSegment(before, segment.number))
      segment.label =
          freeName(segment.label, [&](const std::string& name) { return isTaken(name, segment); });
  return after;
}

// Returns the imported labels with those of a layer, where label n becomes `numbers[n]`. Earlier segments of
// these numbers are gone.
std::shared_ptr<const ImportedLabels> withImported(const ImportedLabels* before, const Segmented& layer,
                                                   const std::array<std::uint8_t, 256>& numbers) {
  const LabelMap& onSlices = layer.acquired->labels;
  ImportedLabels all{{LabelMap(onSlices.geometry())}, LabelMap(layer.labels.geometry())};
  if (before) all = *before;
  for (std::size_t label = 1; label < numbers.size(); ++label) {
    const std::uint8_t number = numbers[label];
    if (number == 0) continue;
    all.onSlices.labels = withLabel(all.onSlices.labels, number, BitMask(onSlices.geometry()));
    all.drawn = withLabel(all.drawn, number, BitMask(layer.labels.geometry()));
    all.onSlices.interpolated.erase(number);
    if (layer.acquired->interpolated.contains(int(label))) all.onSlices.interpolated.insert(number);
  }
  all.onSlices.labels = withLabelsAdded(all.onSlices.labels, onSlices, numbers);
  all.drawn = withLabelsAdded(all.drawn, layer.labels, numbers);
  return std::make_shared<const ImportedLabels>(std::move(all));
}

// Adds segments that take no voxel of the map at `index`, and returns the others. `there` are the maps before
// anything was added.
std::vector<Segment> addWhatFits(AddedSegments& all, std::size_t index, const Segmented& layer,
                                 const std::vector<Segment>& segments, const std::vector<SegmentMap>& there) {
  const LabelMap& labels = layer.labels;
  SegmentMap& map = all.maps[index];
  const std::bitset<256> overlapping = labelsOverlapping(*map.labels, labels);
  std::array<std::uint8_t, 256> numbers{};
  std::vector<Segment> left;
  for (Segment segment : segments) {
    const auto label = std::size_t(segment.number);
    if (overlapping[label] || !freeNumber(map)) {
      left.push_back(std::move(segment));
      continue;
    }
    if (!segment.colour || isColour(there, *segment.colour))
      segment.colour = freeColour(all.maps, map.number, segment.number);
    const SegmentMap before = map;
    map = withNamesApart(before, withSegmentAdded(std::move(map), std::move(segment)), all.maps);
    numbers[label] = std::uint8_t(map.current);
    all.places.push_back({index, map.current});
  }
  if (left.size() == segments.size()) return left;
  map.labels = std::make_shared<const LabelMap>(withLabelsAdded(*map.labels, labels, numbers));
  if (layer.acquired) map.imported = withImported(map.imported.get(), layer, numbers);
  return left;
}

std::size_t indexOfMap(const std::vector<SegmentMap>& maps, int number) {
  return std::size_t(std::ranges::find(maps, number, &SegmentMap::number) - maps.begin());
}

// Records in a map that a segment was moved to it. Recipes with other parameters may make overlapping
// segments, so subtract steps keep them apart. `before` is the map without it; `overlapping` are the labels
// it met there.
SegmentMap withMovedRecorded(const SegmentMap& before, SegmentMap after, const SegmentMap& from, int number,
                             const std::bitset<256>& overlapping) {
  if (!isMadeBySteps(from, number)) return withHandMade(before, std::move(after));
  const std::string own = stepNameOf(after.current);
  std::vector<Step> steps = stepsTaken(from, number, before, after.current);
  for (const Segment& segment : before.segments) {
    if (!overlapping[std::size_t(segment.number)] && !isMadeBySteps(before, segment.number)) continue;
    const std::string other = stepNameOf(segment.number);
    const std::string &less = segment.locked ? own : other, &what = segment.locked ? other : own;
    steps.push_back({"subtract", less, {{"other", what}}});
  }
  return withRecorded(std::move(after), steps);
}

}  // namespace

QString mapName(int number) { return tr("Map %1").arg(number + 1); }

std::string freeName(std::span<const SegmentMap> maps, const std::string& wanted) {
  return freeName(wanted, [&](const std::string& name) {
    return std::ranges::any_of(maps, [&](const SegmentMap& map) { return isCalled(map, name); });
  });
}

glm::u8vec3 freeColour(std::span<const SegmentMap> maps, int map, int number) {
  constexpr int mapsApart = 3;
  return freeTenColour(number + mapsApart * map, [&](glm::u8vec3 colour) { return isColour(maps, colour); });
}

SegmentMap withNewOnesApart(const SegmentMap& before, SegmentMap after,
                            const std::vector<SegmentMap>& ofSeries) {
  after = withNamesApart(before, std::move(after), ofSeries);
  std::vector<SegmentMap> there{before};
  for (const SegmentMap& map : ofSeries)
    if (map.number != after.number) there.push_back(map);
  std::vector<SegmentMap> all = there;
  all.front() = after;
  for (Segment& segment : after.segments)
    if (!findSegment(before, segment.number) && segment.colour && isColour(there, *segment.colour)) {
      segment.colour = freeColour(all, after.number, segment.number);
      all.front() = after;
    }
  return after;
}

AddedSegments withSegmentsAdded(std::vector<SegmentMap> maps, std::span<const Segmented> layers,
                                std::optional<std::size_t> except) {
  const std::vector<SegmentMap> there = maps;
  AddedSegments all{std::move(maps)};
  for (const Segmented& layer : layers) {
    std::vector<Segment> left = layer.segments;
    for (std::size_t n = 0; !left.empty(); ++n) {
      if (n == except) continue;
      if (n == all.maps.size()) all.maps.push_back(furtherMap(all.maps));
      left = addWhatFits(all, n, layer, left, there);
    }
  }
  return all;
}

std::vector<SegmentMap> withSegmentCopied(std::vector<SegmentMap> maps, int map, int number) {
  const auto source = std::ranges::find(maps, map, &SegmentMap::number);
  const Segment* segment = source == maps.end() ? nullptr : findSegment(*source, number);
  if (!segment) return maps;
  Segment copy = *segment;
  copy.colour.reset();
  copy.trackingId.clear();
  copy.trackingUid.clear();
  copy.range.reset();
  copy.span.reset();
  copy.locked = false;
  const LabelMap& labels = *source->labels;
  const auto label = std::uint8_t(number);
  const Segmented voxels{{std::move(copy)},
                         withLabel(LabelMap(labels.geometry()), label, maskOf(labels, label))};
  const auto index = std::size_t(source - maps.begin());
  AddedSegments all = withSegmentsAdded(std::move(maps), {&voxels, 1}, index);
  std::swap(all.maps.front(), all.maps[all.places.front().map]);
  return std::move(all.maps);
}

Result<MovedSegment> withSegmentMoved(std::vector<SegmentMap> maps, int map, int number,
                                      std::optional<int> to) {
  if (!to) {
    maps.push_back(furtherMap(maps));
    to = maps.back().number;
  }
  const std::size_t source = indexOfMap(maps, map), target = indexOfMap(maps, *to);
  const Segment* segment = source < maps.size() ? findSegment(maps[source], number) : nullptr;
  if (!segment || segment->locked || target == maps.size())
    return Error{"The segment to move was locked or removed meanwhile, or the map that it was to be in."};
  const SegmentMap before = maps[target];
  if (!freeNumber(before)) return Error{"There are 255 segments in that map, and no more fit."};
  const BitMask mask = maskOf(*maps[source].labels, std::uint8_t(number));
  const LabelMap alone = withLabel(LabelMap(mask.geometry()), std::uint8_t(number), mask);
  const std::bitset<256> overlapping = labelsOverlapping(alone, *before.labels);
  for (const Segment& other : before.segments)
    if (other.locked && overlapping[std::size_t(other.number)])
      return Error{other.label + " is locked there and has some of its voxels: unlock it first."};
  SegmentMap after = withSegmentAdded(before, *segment);
  after = withMask(std::move(after), after.current, mask);
  std::int64_t taken = 0;
  const auto had = labelCounts(*before.labels), has = labelCounts(*after.labels);
  for (const Segment& other : before.segments)
    taken += had[std::size_t(other.number)] - has[std::size_t(other.number)];
  maps[target] = withMovedRecorded(before, std::move(after), maps[source], number, overlapping);
  maps[source] = withoutSegment(std::move(maps[source]), number);
  std::swap(maps.front(), maps[target]);
  return MovedSegment{std::move(maps), taken};
}

}  // namespace volumen
