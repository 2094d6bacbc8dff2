#pragma once

#include <span>

#include "ui/workspace/segment_surfaces.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

// Fields that draw segments in 3D.

/// Returns the memory limit for the fields of all surfaces: a quarter of the machine's memory.
std::size_t mostSurfaceBytes();
/// Returns the memory used by the field of a surface.
std::size_t bytesOf(const MadeSurface& surface);

// The following functions are slow and meant for other threads.

/// Makes the fields of surfaces in order, from voxels in `kept` (null for all). A field that would exceed
/// `mostBytes` is left out with its reason. `before` is empty or has the last version of each surface under
/// the same mask. Its field is reused if no voxel of the segment has changed. After a cancellation some are
/// unfinished or missing.
void makeFields(std::vector<MadeSurface>& surfaces, const std::vector<MadeSurface>& before,
                const BitMask* kept, std::size_t mostBytes, const CancelToken& cancel = {});

/// Returns the segments of a series' maps as 3D views show them, on the grid of its volume, within
/// `mostBytes`. Maps without labels or on another grid have none. `whole` is the unmasked volume; `mask` is
/// applied.
std::vector<MadeSurface> surfacesOf(std::span<const SegmentMap> maps, const Volume& whole, const Mask& mask,
                                    std::size_t mostBytes, const CancelToken& cancel = {});

}  // namespace volumen
