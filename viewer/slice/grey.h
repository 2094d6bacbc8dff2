#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// Function from value to grey of a window (PS3.3 C.11.2, slices.md 3).
enum class WindowFunction {
  linear,       ///< DICOM's LINEAR, for integers stored by DICOM; widths below 1 count as 1
  linearExact,  ///< (v - c) / w + 1/2, clamped
  sigmoid       ///< 1 / (1 + exp(-4 (v - c) / w))
};

/// A VOI LUT (PS3.3 C.11.2.1.1): grey in 0..1 for values from `first` on, continued beyond both ends. Values
/// between two integers take the nearest entry; halves round up.
struct GreyTable {
  double first = 0;
  std::vector<float> grey;
  bool operator==(const GreyTable&) const = default;
};

/// Maps values (after rescale) to grey. A table, if present, replaces the window. Widths are positive.
struct GreyMapping {
  Window window;
  WindowFunction function = WindowFunction::linearExact;
  GreyTable table;        ///< Empty if the window applies
  bool inverted = false;  ///< MONOCHROME1 or Presentation LUT Shape INVERSE; both together invert once

  bool operator==(const GreyMapping&) const = default;
};

/// Returns the grey in 0..1; NaN stays NaN.
double greyOf(double value, const GreyMapping& mapping);

/// Returns floor(255 y + 1/2) of the grey y of each value, or `outside` for NaN. It is exact for linear and
/// linearExact: y is not rounded before.
std::vector<std::uint8_t> greyBytes(std::span<const float> values, const GreyMapping& mapping,
                                    std::uint8_t outside = 0);

}  // namespace volumen
