#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "results/segments/segment_map.h"
#include "ui/workspace/workspace.h"

namespace volumen {

// Segments of a series in the workspace. The functions leave a series without such a segment as it is.

/// Returns whether the file of one of its maps was not read.
bool missesSegments(const Workspace& workspace, const SeriesKey& series);
/// Makes this map of a series the current one. Does nothing if there is none.
Workspace withMapWorkedOn(Workspace workspace, const SeriesKey& series, int number);
/// Returns `map` as a further map of a series: with another number if its own is taken, and shown as the
/// others are.
SegmentMap asMapOf(const Workspace& workspace, const SeriesKey& series, SegmentMap map);
/// Returns the maps of a series on a grid, the current one first, the others by number. Returns a single
/// empty map if the current one lies on another grid or does not exist.
std::vector<SegmentMap> segmentMapsOn(const Workspace& workspace, const SeriesKey& series,
                                      const VoxelGeometry& grid);
/// Replaces the maps of a series with the same numbers, and makes the first one current.
Workspace withSegmentMapsOf(Workspace workspace, const std::vector<SegmentMap>& maps);

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
