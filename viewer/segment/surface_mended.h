#pragma once

#include "viewer/segment/surface.h"

namespace volumen {

/// Returns the surface of a field (volumePreservingSurface()) with most thin triangles improved. Points move
/// along the surface to places with nearly the same field value, where the worst triangle around them gets
/// better. Triangles and topology stay the same, and the surface stays within half a voxel of the voxel
/// border. Files hold this surface: it encloses what pictures draw to 1 %, for real segments to 0.5 %. If
/// cancelled, returns the surface so far.
Surface mended(Surface surface, const OccupancyField& field, const CancelToken& cancel = {});

}  // namespace volumen
