#include "viewer/segment/acquired_slices.h"

#include <algorithm>
#include <cmath>

#include "viewer/volume/parallel.h"

namespace volumen {

BitMask onAcquired(const BitMask& mask, const AcquiredSlices& slices) {
  BitMask placed(slices.volume->geometry());
  parallelFor(placed.size().z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t slice = begin; slice < end; ++slice) {
      const double k = std::floor(slices.places[std::size_t(slice)] + 0.5);
      const int nearest = int(std::clamp(k, 0.0, mask.size().z - 1.0));
      for (int j = 0; j < placed.size().y; ++j)
        std::ranges::copy(mask.row(j, nearest), placed.row(j, int(slice)).begin());
    }
  });
  return placed;
}

}  // namespace volumen
