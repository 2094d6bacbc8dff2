#pragma once

#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// A slice of the trachea in a CT. Slices across the axis of the grid nearest to the patient's are looked
/// through from above: the first with a region of at most -800 HU inside the body, of 60 to 700 mm^2 and at
/// most twice as wide as long, that goes on downwards for 3 cm in such regions; of several the one nearest to
/// the body's middle. The Error: there is none, or the grid is not calibrated.
Result<BitMask> tracheaOf(const Volume& volume, const BitMask& body, const CancelToken& cancel = {});

/// How far an air tree may grow.
struct AirTreeLimits {
  double most = -600;  ///< value
  double mostMl = 60;
};

/// What is joined by faces to the seeds through values up to T, where T is the highest value (to 1, at most
/// limits.most) at which that is no larger than limits.mostMl: above, it leaks into the lung. The Error: no
/// seed, or it is larger wherever it holds one.
Result<BitMask> airTreeOf(const Volume& volume, const std::vector<glm::ivec3>& seeds, AirTreeLimits limits,
                          const CancelToken& cancel = {});

}  // namespace volumen
