#pragma once

#include <array>

#include "viewer/volume/volume.h"

namespace volumen {

/// A part of something, and how far it may be off.
struct Part {
  double part = 0, error = 0;

  void operator+=(Part other) { part += other.part, error += other.error; }
};

/// The part of a cell, 0 to 1, in which the trilinear value of its corners (x fastest, then y, z) lies in the
/// range, as rangeVolume() describes it. Squares are cut until the estimate of their error is below
/// `tolerance` times their edge: most of it lies along lines, where the parts bend.
Part partInRange(const std::array<double, 8>& corners, ValueRange range, double tolerance);

}  // namespace volumen
