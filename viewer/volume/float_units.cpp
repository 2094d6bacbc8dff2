#include "viewer/volume/float_units.h"

#include <algorithm>

namespace volumen {

FloatUnits floatUnits(ValueRange range) {
  const double width = range.high - range.low, most = std::max(std::abs(range.low), std::abs(range.high));
  // Farther away, sums and interpolation would round off what can be seen of narrow curves. The difference of
  // floats that lie so close together is a float.
  const bool isFar = most > 16 * width;
  const double size = width > 0 && isFar ? width : most;
  if (size == 0) return {};
  // The smallest are counted from 1 on; the largest are not, as they may be a few beside ordinary ones.
  const int exponent = std::ilogb(size), counted = exponent < -60 ? 0 : std::min(exponent, 60);
  return {std::exp2(exponent - counted), isFar ? range.low : 0};
}

}  // namespace volumen
