#pragma once

#include "io/contours.h"
#include "viewer/segment/segmentation.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Returns the regions of a structure set as planes of pixels like those of the slices of `grid`. A pixel is
/// set if its centre lies inside an odd number of the region's contours in its plane. `places` are the
/// positions of the acquired slices along k of the grid, in slices; empty: every slice of the grid is one.
/// Contours on acquired slices fill these alone. If some lie between them, all planes are as thick as the
/// smallest distance of two of a region, at least that of slices.
/// Notes say in ml what pixels do not hold, and which contours are left out: points, lines, outlines that are
/// not parallel to the slices. The result is incomplete if cancelled.
Segmentation filledContours(const StructureSet& contours, const VoxelGeometry& grid,
                            const std::vector<double>& places = {}, const CancelToken& cancel = {});

}  // namespace volumen
