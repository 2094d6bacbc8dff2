#pragma once

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// From which value on a voxel may belong to a lesion.
struct LesionThreshold {
  double amount = 0.41;  ///< of the largest value of the region, or the value itself
  bool isShare = true;
  bool operator==(const LesionThreshold&) const = default;
};

/// A lesion in PET: of the voxels of a region from the threshold on the part, connected by faces, that holds
/// the region's largest value (of several voxels the first in memory). Padding is no value. 41 % and 50 % of
/// the largest SUV are those of the EANM guidelines for FDG, version 2 (Boellaard et al. 2015). The Error, in
/// lower case and without a full stop: the region has no value, none from the threshold on, or what is found
/// has a voxel beside one of the grid outside the region: it leaks.
Result<BitMask> lesionIn(const BitMask& region, const Volume& volume, LesionThreshold threshold,
                         const CancelToken& cancel = {});

}  // namespace volumen
