#pragma once

#include <cmath>
#include <type_traits>
#include <vector>

#include "viewer/volume/histogram.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// How real values are counted where they are computed with in floats: value = slope * number + intercept. No
/// step of the values is lost, and neither their differences nor products of these leave what floats hold.
struct FloatUnits {
  double slope = 1;      ///< a power of two
  double intercept = 0;  ///< the smallest value where all lie far from 0 beside their range, else 0
  bool operator==(const FloatUnits&) const = default;
};

/// The units of values of this range; those of ordinary ones are the values themselves.
FloatUnits floatUnits(ValueRange range);

/// A value in these units, rounded once.
inline float inUnits(float value, const FloatUnits& units) {
  return float((double(value) - units.intercept) / units.slope);
}

/// Calls use(samples, sign) with what gradients in floats are computed from: integers as they are stored,
/// floats in their units. Real value = sign * scale * sample, but for the intercept; returns the scale, > 0.
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
