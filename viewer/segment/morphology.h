#pragma once

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// By a ball of radiusMm in patient space, on any grid: voxel b is in the ball about voxel a where
/// |L (b - a)| <= radiusMm (1 + 1e-9), L the step of the grid (a ball smaller than every step is its middle
/// alone). Outside the grid nothing is set and nothing is unset: growing brings nothing in, shrinking takes
/// nothing from the border. Radii are >= 0; the cost grows with their square (rows of the grid in a ball
/// times voxels of the grid). A cancelled one is returned half done.
BitMask grown(const BitMask& mask, double radiusMm, const CancelToken& cancel = {});
BitMask shrunk(const BitMask& mask, double radiusMm, const CancelToken& cancel = {});
/// Grown, then shrunk, as if the grid went on (but along an axis of one voxel, where a ball is flat): closes
/// gaps, and does not fill up what is between the mask and the border. A ball is cut off where it reaches
/// farther than 32 voxels and twice the grid along an axis.
BitMask closed(const BitMask& mask, double radiusMm, const CancelToken& cancel = {});
/// Shrunk, then grown: takes away what no ball fits in.
BitMask opened(const BitMask& mask, double radiusMm, const CancelToken& cancel = {});
/// The outermost radiusMm of it: without what shrunk() leaves.
BitMask shell(const BitMask& mask, double radiusMm, const CancelToken& cancel = {});

}  // namespace volumen
