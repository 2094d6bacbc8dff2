#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ui/workspace/workspace.h"
#include "viewer/segment/bit_mask.h"

namespace volumen {

/// Returns the segment with this number, or null.
const Segment* findSegment(const SegmentMap& map, int number);
/// Returns the segment that panel and tools work on: the chosen one, else the first; null if there are none.
const Segment* currentSegment(const SegmentMap& map);
/// Returns the smallest unused number; empty if all 255 are taken.
std::optional<int> freeNumber(const SegmentMap& map);
/// Returns `wanted`, with a number behind it if another segment has that name: "Bone (2)".
std::string freeName(const SegmentMap& map, const std::string& wanted);
/// Returns the colour of a number, which new segments get as their own (freeColour()). Every file states it,
/// as other programs choose colours for segments without one.
glm::u8vec3 colourOfNumber(int number);
/// Returns the numbers of locked segments.
std::vector<std::uint8_t> lockedNumbers(const SegmentMap& map);
/// Returns whether the labels lie on this grid; false if they were not read.
bool isOn(const SegmentMap& map, const VoxelGeometry& grid);

// The functions below are slow in large volumes: call them on other threads. The map has labels.

/// Gives a segment exactly these voxels, but none of a locked segment. Does nothing if there is no such
/// segment or it is locked.
SegmentMap withMask(SegmentMap map, int number, const BitMask& mask);
/// Removes a segment; its voxels become background, and the segment before it is current. Does nothing if
/// there is no such segment or it is locked.
SegmentMap withoutSegment(SegmentMap map, int number);

// The functions below are fast. They leave a series without such a segment as it is.

/// Adds a segment without voxels and makes it current; its number must be free. Without a colour it gets one
/// that no other segment there has.
SegmentMap withSegment(SegmentMap map, Segment segment);
/// Adds a segment without voxels and makes it current. It keeps its number if free, else gets the smallest
/// free one. It gets a colour and a name if it has none, and another name if its own is taken. Does nothing
/// if there are 255.
SegmentMap withSegmentAdded(SegmentMap map, Segment segment);
/// Changes a segment of the current map, such as name, colour, visibility and lock. Its number stays.
Workspace withSegmentChanged(Workspace workspace, const SeriesKey& series, int number,
                             const std::function<void(Segment&)>& change);
/// Makes this segment of the current map current.
Workspace withCurrentSegment(Workspace workspace, const SeriesKey& series, int number);
/// Draws the segments of a series in 3D as well, or only in slices.
Workspace withSegmentsIn3d(Workspace workspace, const SeriesKey& series, bool in3d);
/// Sets where the volume of a series is shown in 3D.
Workspace withTissueShown(Workspace workspace, const SeriesKey& series, const TissueShown& tissue);
/// Adds a segment without voxels to a map (empty: the current one) of a series whose volume has this grid,
/// and makes it current. Replaces segments of other grids. Its number is as in withSegmentAdded(); name and
/// colour are unique in the series.
Workspace withNewSegment(Workspace workspace, const SeriesKey& series, const VoxelGeometry& grid,
                         Segment segment, std::optional<int> map = {});

/// Returns the map with a number (empty: the current one) of a series on a grid. Returns an empty map if
/// there is none or it lies on another grid.
SegmentMap segmentMapOn(const Workspace& workspace, const SeriesKey& series, const VoxelGeometry& grid,
                        std::optional<int> number = {});

}  // namespace volumen
