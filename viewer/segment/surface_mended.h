#pragma once

#include "viewer/segment/surface.h"

namespace volumen {

/// The surface of a field (volumePreservingSurface()) without most of its thin triangles: points move along
/// it, to where the field has the same value as before, so that the worst triangle about them gets better. It
/// has the same triangles, is as closed, and stays within half a voxel of the border of the voxels.
/// Cancelled: as far as it has come by then.
Surface mended(Surface surface, const OccupancyField& field, const CancelToken& cancel = {});

}  // namespace volumen
