#pragma once

#include "app/exports/exports.h"
#include "io/export/slice_stack.h"

namespace volumen {

/// Returns the planes of a job through a whole volume, or the only one if its place is given. The Error is
/// one of makePlane() or stackThrough().
Result<SliceStack> planeStack(const ExportJob& job, const AskedPlane& asked, const VoxelGeometry& geometry);

/// Returns the planes across the curve of --roi. The Error: the file cannot be read, holds no curve in the
/// patient or several, or it is one of makePlane() or stackAlong().
Result<SliceStack> curveStack(const ExportJob& job, const AskedPlane& asked, const VoxelGeometry& geometry);

}  // namespace volumen
