#include "viewer/volume/float_units.h"

#include <algorithm>

namespace volumen {

FloatUnits floatUnits(ValueRange range) {
  const double width = range.high - range.low, most = std::max(std::abs(range.low), std::abs(range.high));
  // Far from 0, sums and interpolation would round off differences that narrow curves show. Differences of
  // floats this close together are exact.
  const bool isFar = most > 16 * width;
  const double size = width > 0 && isFar ? width : most;
  if (size == 0) return {};
  // Tiny values are scaled to about 1. Huge ones may be a few among ordinary ones, so they stay as large as
  // 2^60.
  const int exponent = std::ilogb(size), counted = exponent < -60 ? 0 : std::min(exponent, 60);
  return {std::exp2(exponent - counted), isFar ? range.low : 0};
}

}  // namespace volumen
