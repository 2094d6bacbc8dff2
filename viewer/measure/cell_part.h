#pragma once

#include <array>

#include "viewer/volume/volume.h"

namespace volumen {

/// A fraction of a whole, and a bound on its error.
struct Part {
  double part = 0, error = 0;

  void operator+=(Part other) { part += other.part, error += other.error; }
};

/// Returns the fraction of a cell, 0 to 1, in which its trilinear value lies in the range, as rangeVolume()
/// describes. `corners`: x fastest, then y, z. Squares are subdivided until their estimated error is below
/// `tolerance` times their edge. Most of the error lies along lines, where the fractions bend.
Part partInRange(const std::array<double, 8>& corners, ValueRange range, double tolerance);

}  // namespace volumen
