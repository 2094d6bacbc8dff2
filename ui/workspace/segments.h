#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ui/workspace/workspace.h"
#include "viewer/segment/bit_mask.h"

namespace volumen {

/// The segment of a number; null: there is none.
const Segment* findSegment(const SegmentMap& map, int number);
/// The one that panel and tools work on: the chosen one, else the first; null: there are none.
const Segment* currentSegment(const SegmentMap& map);
/// The smallest number that no segment has; none: all 255 are taken.
std::optional<int> freeNumber(const SegmentMap& map);
/// `wanted`, or with a number behind it where another segment is called so: "Bone (2)".
std::string freeName(const SegmentMap& map, const std::string& wanted);
/// The colour of a number, which new segments have as their own (freeColour()): in every file, also where
/// others choose those of segments without one.
glm::u8vec3 colourOfNumber(int number);
/// The numbers of the locked segments.
std::vector<std::uint8_t> lockedNumbers(const SegmentMap& map);
/// Whether its labels lie on this grid; not where they were not read.
bool isOn(const SegmentMap& map, const VoxelGeometry& grid);

// What follows takes time in large volumes: for other threads. The map has labels.

/// With exactly these voxels in a segment; none of a locked one is changed. As it was where there is no such
/// segment, or it is locked.
SegmentMap withMask(SegmentMap map, int number, const BitMask& mask);
/// Without a segment, whose voxels become background; the one before it is current. As it was where there is
/// no such segment, or it is locked.
SegmentMap withoutSegment(SegmentMap map, int number);

// What follows takes no time. A series without such a segment stays as it is.

/// With another segment of the map, which has no voxels yet and is current; its number must be free. It gets
/// a colour that no other one there has where it has none.
SegmentMap withSegment(SegmentMap map, Segment segment);
/// With another segment that has no voxels yet and is current. It keeps its number where that is free, else
/// it has the smallest that is; it gets a colour and a name where it has none, and another name where that is
/// taken. As it was where 255 are there.
SegmentMap withSegmentAdded(SegmentMap map, Segment segment);
/// With a segment of the map that is worked on called, coloured, shown, locked otherwise; its number stays.
Workspace withSegmentChanged(Workspace workspace, const SeriesKey& series, int number,
                             const std::function<void(Segment&)>& change);
/// With this segment of the map that is worked on current.
Workspace withCurrentSegment(Workspace workspace, const SeriesKey& series, int number);
/// With the segments of a series drawn in 3D, too, or in slices alone.
Workspace withSegmentsIn3d(Workspace workspace, const SeriesKey& series, bool in3d);
/// With the volume of a series shown in 3D there.
Workspace withTissueShown(Workspace workspace, const SeriesKey& series, const TissueShown& tissue);
/// With another segment without voxels in a map (none: that which is worked on) of a series whose volume has
/// this grid, current there, in place of segments of other grids; its number as withSegmentAdded() has it,
/// its name and colour such as no segment of the series has.
Workspace withNewSegment(Workspace workspace, const SeriesKey& series, const VoxelGeometry& grid,
                         Segment segment, std::optional<int> map = {});

/// The map of a number (none: that which is worked on) of a series on a grid; where there is none, or it lies
/// on another one, an empty map.
SegmentMap segmentMapOn(const Workspace& workspace, const SeriesKey& series, const VoxelGeometry& grid,
                        std::optional<int> number = {});

}  // namespace volumen
