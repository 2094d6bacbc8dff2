#pragma once

#include "app/exports/exports.h"
#include "io/export/slice_stack.h"

namespace volumen {

/// Returns the planes of a job through a whole volume, or the only one if its place is given. The Error is
/// one of makePlane() or stackThrough().
Result<SliceStack> planeStack(const ExportJob& job, const AskedPlane& asked, const VoxelGeometry& geometry);

}  // namespace volumen
