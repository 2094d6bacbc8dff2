#pragma once

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Dilation (grown) and erosion (shrunk) by a ball of `radiusMm` >= 0 in patient space, on any grid. Voxel b
/// is in the ball around voxel a if |L (b - a)| <= radiusMm (1 + 1e-9), with L the voxel step matrix. A ball
/// smaller than every step is its centre alone. Voxels outside the grid count as neither set nor unset:
/// growing takes nothing in from there and shrinking does not erode at the border. The cost grows with the
/// square of the radius (rows in the ball times voxels). The result is incomplete if cancelled.
BitMask grown(const BitMask& mask, double radiusMm, const CancelToken& cancel = {});
BitMask shrunk(const BitMask& mask, double radiusMm, const CancelToken& cancel = {});
/// Closing: grown, then shrunk, as if the grid continued beyond its border (except along axes of one voxel,
/// where the ball is flat). It closes gaps but does not fill the space between the mask and the border. The
/// ball is cut off beyond 32 voxels and twice the grid along an axis.
BitMask closed(const BitMask& mask, double radiusMm, const CancelToken& cancel = {});
/// Opening: shrunk, then grown. Removes parts that are too thin for the ball.
BitMask opened(const BitMask& mask, double radiusMm, const CancelToken& cancel = {});
/// Returns the outer layer of thickness `radiusMm`: the mask without shrunk().
BitMask shell(const BitMask& mask, double radiusMm, const CancelToken& cancel = {});

}  // namespace volumen
