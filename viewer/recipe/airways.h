#pragma once

#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Returns a slice of the trachea in a CT. Slices across the grid axis nearest to the patient's are searched
/// from above. The trachea is the first region inside the body of at most -800 HU and 60 to 700 mm^2, with an
/// aspect ratio of at most 2. It must continue downwards for 3 cm through such regions. Of several, the one
/// nearest to the body's centre counts. The Error means: none found, or the grid is not calibrated.
Result<BitMask> tracheaOf(const Volume& volume, const BitMask& body, const CancelToken& cancel = {});

/// Growth limits of an air tree.
struct AirTreeLimits {
  double most = -600;  ///< Largest value
  double mostMl = 60;
};

/// Returns the voxels 6-connected to the seeds through values up to T. T is the highest value (to within 1,
/// at most limits.most) at which the tree is no larger than limits.mostMl; above, it leaks into the lung. The
/// Error means: no seed, or the tree is too large at every value that reaches a seed.
Result<BitMask> airTreeOf(const Volume& volume, const std::vector<glm::ivec3>& seeds, AirTreeLimits limits,
                          const CancelToken& cancel = {});

}  // namespace volumen
