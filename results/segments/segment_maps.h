#pragma once

#include <QString>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/segments/segment_map.h"
#include "viewer/segment/segmented.h"
#include "viewer/volume/result.h"

namespace volumen {

// Several maps of one series hold overlapping segments. All of them have one grid.

/// Returns the display name of a map: "Map 2".
QString mapName(int number);

/// Returns `wanted`, with a number behind it if a segment of these maps has that name: "Bone (2)", then "Bone
/// (3)".
std::string freeName(std::span<const SegmentMap> maps, const std::string& wanted);
/// Returns the colour of a new segment by its number and map. If a segment of these maps has it, returns the
/// next unused colour; if all are used, that of the number.
glm::u8vec3 freeColour(std::span<const SegmentMap> maps, int map, int number);
/// Returns `after`, made from `before`, with new segments that have names unique in the series, and colours
/// that no earlier segment has.
SegmentMap withNewOnesApart(const SegmentMap& before, SegmentMap after,
                            const std::vector<SegmentMap>& ofSeries);

/// A segment of one of several maps.
struct SegmentPlace {
  std::size_t map;  ///< index
  int number;
  bool operator==(const SegmentPlace&) const = default;
};
/// Maps with added segments, and the places of these in the order of maps.
struct AddedSegments {
  std::vector<SegmentMap> maps;
  std::vector<SegmentPlace> places{};
};

// The functions below are slow in large volumes: call them on other threads. The maps have labels, and there
// is at least one.

/// Adds the segments of layers, each to the first map (not that at `except`) in which it takes no voxel, else
/// to a further map. They keep numbers, names and colours that are free. A colour is free if no earlier
/// segment has it.
AddedSegments withSegmentsAdded(std::vector<SegmentMap> maps, std::span<const Segmented> layers,
                                std::optional<std::size_t> except = {});
/// Copies a segment under another name to the first other map in which it takes no voxel. That map comes
/// first, and the copy is current. Does nothing if there is no such segment.
std::vector<SegmentMap> withSegmentCopied(std::vector<SegmentMap> maps, int map, int number);

/// Maps with a moved segment. Its map comes first, and the segment is current there.
struct MovedSegment {
  std::vector<SegmentMap> maps;
  std::int64_t taken;  ///< voxels that it took from segments there
};
/// Moves a segment to map `to` (empty: a further one), with its properties and the steps that made it. It
/// keeps its number if that is free there, and takes its voxels from segments there. Returns an Error if one
/// of them is locked or the move is impossible.
Result<MovedSegment> withSegmentMoved(std::vector<SegmentMap> maps, int map, int number,
                                      std::optional<int> to);

}  // namespace volumen
