#pragma once

#include "ui/workspace/segment_surfaces.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

// What segments are drawn by in 3D. Both take their time: for other threads.

/// The field of a segment of `labels`, of its voxels that are in `kept` (null: of all). That of `before`,
/// whose mask left the same, where no voxel of the segment has changed since. A cancelled one is half done.
/// The Error: it would take more than so many bytes.
Result<std::shared_ptr<const OccupancyField>> surfaceFieldOf(const LabelMap& labels, int number,
                                                             const BitMask* kept, std::size_t mostBytes,
                                                             const MadeSurface* before = nullptr,
                                                             const CancelToken& cancel = {});

/// The segments of a map as 3D views of its series show them, however much memory that takes, on the grid of
/// its volume; none where the map lies on another grid or has no labels. `whole`: the volume without what the
/// mask takes away of it.
std::vector<SegmentSurface> surfacesOf(const SegmentMap& map, const Volume& whole, const Mask& mask,
                                       const CancelToken& cancel = {});

}  // namespace volumen
