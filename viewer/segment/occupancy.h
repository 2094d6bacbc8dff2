#pragma once

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/occupancy_field.h"

namespace volumen {

/// Returns the smoothed occupancy of a mask: a Gaussian of `sigma` (at most 1) voxels along each grid axis;
/// at 0 it is 1 inside, 0 outside.
/// Thin parts are kept if sigma > 0. Voxels of the segment in no 2 x 2 x 2 box of it get at least the value
/// that keeps a one-voxel plate one voxel thick. Voxels in no 2 x 2 square raise the field to at least min(1,
/// 4 G(0.65)), at most 0.36 beside them: lines stay connected in every direction.
/// Values are at least 1/2 + 0.02 in the segment and at most 1/2 - 0.02 outside. The surface therefore always
/// passes between the centres of inside and outside voxels. Nothing is inside beyond the grid.
/// The box of an empty mask is empty (high < low). Runs on all cores; a cancelled result is incomplete or has
/// no box.
OccupancyField occupancyOf(const BitMask& mask, double sigma, const CancelToken& cancel = {});
/// Returns the size of the values of occupancyOf() in bytes.
std::size_t occupancyBytes(const BitMask& mask, double sigma);
/// Returns the volume where the trilinear field is at least 1/2, in mm^3, as pictures draw it. Cells that are
/// partly inside are integrated over 5 x 5 lines along the steepest axis, each exact. The result is the same
/// for any number of threads and undefined if cancelled.
double volumeOf(const OccupancyField& field, const CancelToken& cancel = {});
inline constexpr double surfaceSigma = 0.7;  ///< Voxels; used for pictures and files

}  // namespace volumen
