#pragma once

#include <QString>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ui/workspace/workspace.h"
#include "viewer/segment/segmented.h"
#include "viewer/volume/result.h"

namespace volumen {

// Several maps of one series, which hold what overlaps. All of them have a grid in common.

/// What people call a map: "Map 2".
QString mapName(int number);

/// Whether the file of one of its maps was not read.
bool missesSegments(const Workspace& workspace, const SeriesKey& series);
/// With this map of a series the one that is worked on; as it was where there is none.
Workspace withMapWorkedOn(Workspace workspace, const SeriesKey& series, int number);
/// `map` as one more of a series: where one there has its number it gets another one, and it is shown as they
/// are.
SegmentMap asMapOf(const Workspace& workspace, const SeriesKey& series, SegmentMap map);
/// The maps of a series on a grid, the one that is worked on first, the others by their numbers; where that
/// one lies on another grid, or there is none, an empty one alone.
std::vector<SegmentMap> segmentMapsOn(const Workspace& workspace, const SeriesKey& series,
                                      const VoxelGeometry& grid);
/// With these maps of a series in place of those of their numbers, the first worked on.
Workspace withSegmentMapsOf(Workspace workspace, const std::vector<SegmentMap>& maps);

/// `wanted`, or with a number behind it where a segment of these maps is called so: "Bone (2)", and of that
/// "Bone (3)".
std::string freeName(std::span<const SegmentMap> maps, const std::string& wanted);
/// The colour that a new segment of this number in a map of this number has: where a segment of these maps
/// has that, the next one that none has; where they have all, that of the number.
glm::u8vec3 freeColour(std::span<const SegmentMap> maps, int map, int number);
/// `after`, which was made of `before`, with its new segments called as none of the series, and coloured as
/// none that was there before.
SegmentMap withNewOnesApart(const SegmentMap& before, SegmentMap after,
                            const std::vector<SegmentMap>& ofSeries);

/// A segment of one of several maps.
struct SegmentPlace {
  std::size_t map;  ///< index
  int number;
  bool operator==(const SegmentPlace&) const = default;
};
/// Maps with segments that were added, and where these are, in the order of maps.
struct AddedSegments {
  std::vector<SegmentMap> maps;
  std::vector<SegmentPlace> places{};
};

// What follows takes time in large volumes: for other threads. The maps have labels, and there is one at
// least.

/// With the segments of layers, each in the first map, but for the one at `except`, of which it takes no
/// voxel; else in a further one. They keep numbers, names and colours where those are free; of colours, where
/// no segment that was there before has them.
AddedSegments withSegmentsAdded(std::vector<SegmentMap> maps, std::span<const Segmented> layers,
                                std::optional<std::size_t> except = {});
/// With a copy of a segment, called otherwise, in the first other map where it takes no voxel; that map
/// first, the copy current. As they were where there is no such segment.
std::vector<SegmentMap> withSegmentCopied(std::vector<SegmentMap> maps, int map, int number);

/// Maps with a segment that was moved, the one that it is in first, it current there.
struct MovedSegment {
  std::vector<SegmentMap> maps;
  std::int64_t taken;  ///< voxels that it took from segments there
};
/// With a segment in another map, that of the number `to` (none: a further one), with all that it is and the
/// steps that made it; its number stays where it is free there. It takes its voxels from those there; the
/// Error says that one of them is locked, or what else keeps it.
Result<MovedSegment> withSegmentMoved(std::vector<SegmentMap> maps, int map, int number,
                                      std::optional<int> to);

}  // namespace volumen
