#pragma once

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/occupancy_field.h"

namespace volumen {

/// Gaussian of `sigma` voxels along each axis of the grid (at most 1; 0: 1 inside, 0 outside), with thin
/// parts kept: voxels that no box of 2 x 2 x 2 voxels of the segment covers have at least what leaves a plate
/// of one voxel one voxel thick, and those that no square of 2 x 2 covers add min(1, 4 G(0.65)), beside them
/// at most 0.36: lines stay in one piece, whichever way they run. Clamped to at least 1/2 + 0.02 at voxels of
/// the segment and at most 1/2 - 0.02 at all others: the surface passes between the centres of voxels inside
/// and outside, never elsewhere. Beyond the grid nothing is inside. Of no voxels the box is empty (high <
/// low). On all cores; a cancelled one is half done, or has no box.
OccupancyField occupancyOf(const BitMask& mask, double sigma, const CancelToken& cancel = {});
/// Bytes of the values of that.
std::size_t occupancyBytes(const BitMask& mask, double sigma);
/// Where the trilinear field is at least 1/2, mm^3: what pictures draw. Of cells that are in part inside by
/// 5 x 5 lines along the steepest axis,
/// each exact. The same digits for any number of threads; cancelled: any number.
double volumeOf(const OccupancyField& field, const CancelToken& cancel = {});
inline constexpr double surfaceSigma = 0.7;  ///< voxels: of pictures and of files alike

}  // namespace volumen
