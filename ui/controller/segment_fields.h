#pragma once

#include <span>

#include "ui/workspace/segment_surfaces.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

// What segments are drawn by in 3D.

/// What the fields of all surfaces may take in memory together: a quarter of the machine's.
std::size_t mostSurfaceBytes();
/// What the field of a surface takes.
std::size_t bytesOf(const MadeSurface& surface);

// What follows takes its time: for other threads.

/// Makes the fields of surfaces in their order, of the voxels that are in `kept` (null: of all); one for
/// which the others leave no room of so many bytes gets none, and says why not. `before`: of each, or empty,
/// the last one, whose mask left the same; its field is taken where no voxel of the segment has changed
/// since. Cancelled, some are half done, or not at all.
void makeFields(std::vector<MadeSurface>& surfaces, const std::vector<MadeSurface>& before,
                const BitMask* kept, std::size_t mostBytes, const CancelToken& cancel = {});

/// The segments of the maps of a series as 3D views of it show them, on the grid of its volume, in so many
/// bytes; none of a map that lies on another grid or has no labels. `whole`: the volume without what the mask
/// takes away of it.
std::vector<MadeSurface> surfacesOf(std::span<const SegmentMap> maps, const Volume& whole, const Mask& mask,
                                    std::size_t mostBytes, const CancelToken& cancel = {});

}  // namespace volumen
