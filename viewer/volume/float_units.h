#pragma once

#include <cmath>
#include <type_traits>
#include <vector>

#include "viewer/volume/histogram.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Units for float arithmetic on real values: value = slope * number + intercept. They preserve every step
/// between values, and keep differences and their products within the range of floats.
struct FloatUnits {
  double slope = 1;      ///< A power of two
  double intercept = 0;  ///< The smallest value if all are far from 0 compared with their range, else 0
  bool operator==(const FloatUnits&) const = default;
};

/// Returns the units for values of this range; ordinary values stay as they are.
FloatUnits floatUnits(ValueRange range);

/// Returns a value in these units, rounded once.
inline float inUnits(float value, const FloatUnits& units) {
  return float((double(value) - units.intercept) / units.slope);
}

/// Calls use(samples, sign) with the input of float gradients: integers as stored, floats in their units.
/// Real value = sign * scale * sample, apart from the intercept. Returns the scale, > 0.
template <class Use>
double withFloatUnits(const Volume& volume, const Use& use) {
  return std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        if constexpr (std::is_same_v<T, float>) {
          const FloatUnits units = floatUnits(valueRange(volume));
          if (units == FloatUnits()) {
            use(stored, 1.0f);
            return 1.0;
          }
          std::vector<float> numbers;
          numbers.reserve(stored.size());
          for (float v : stored) numbers.push_back(inUnits(v, units));
          use(numbers, 1.0f);
          return units.slope;
        } else {
          use(stored, volume.slope() < 0 ? -1.0f : 1.0f);
          return std::abs(volume.slope());
        }
      },
      volume.stored());
}

}  // namespace volumen
