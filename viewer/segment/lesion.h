#pragma once

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Smallest value of voxels that may belong to a lesion.
struct LesionThreshold {
  double amount = 0.41;  ///< Fraction of the region's maximum, or the value itself
  bool isShare = true;
  bool operator==(const LesionThreshold&) const = default;
};

/// Segments a lesion in PET: the 6-connected component, of the region's voxels at or above the threshold,
/// that holds the region's maximum (of equal maxima, the first in memory). Padding is ignored. Thresholds of
/// 41 % and 50 % of SUVmax follow the EANM guidelines for FDG, version 2 (Boellaard et al. 2015).
/// The Error (lower case, no full stop) means: the region has no value, none reaches the threshold, or the
/// lesion touches a grid voxel outside the region, that is, it leaks.
Result<BitMask> lesionIn(const BitMask& region, const Volume& volume, LesionThreshold threshold,
                         const CancelToken& cancel = {});

}  // namespace volumen
