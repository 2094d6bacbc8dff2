#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// How a window turns values into grey (PS3.3 C.11.2, SLICE 3).
enum class WindowFunction {
  linear,       ///< DICOM's LINEAR, for stored integers of DICOM; a width below 1 counts as 1
  linearExact,  ///< (v - c) / w + 1/2, clamped
  sigmoid       ///< 1 / (1 + exp(-4 (v - c) / w))
};

/// A VOI LUT: grey in 0..1 for values from `first` on, the ends' beyond them (PS3.3 C.11.2.1.1); between two
/// whole values the nearer one's, in the middle the upper one's.
struct GreyTable {
  double first = 0;
  std::vector<float> grey;
  bool operator==(const GreyTable&) const = default;
};

/// From a value (after rescale) to grey. A table, where there is one, stands in for the window. Widths are
/// above 0.
struct GreyMapping {
  Window window;
  WindowFunction function = WindowFunction::linearExact;
  GreyTable table;        ///< empty: the window counts
  bool inverted = false;  ///< MONOCHROME1, or Presentation LUT Shape INVERSE: once, not twice

  bool operator==(const GreyMapping&) const = default;
};

/// Grey in 0..1; NaN stays NaN.
double greyOf(double value, const GreyMapping& mapping);

/// floor(255 y + 1/2) of each value's grey y; `outside` for NaN. Of linear and linearExact this is exact: y
/// is not rounded before.
std::vector<std::uint8_t> greyBytes(std::span<const float> values, const GreyMapping& mapping,
                                    std::uint8_t outside = 0);

}  // namespace volumen
