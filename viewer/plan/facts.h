#pragma once

#include <memory>

#include "viewer/volume/block_ranges.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Everything that planning rules may ask about a volume. It is a value, so that tests can make one up.
struct VolumeFacts {
  VoxelGeometry geometry;
  bool integers = true;  ///< True if 8- or 16-bit stored integers tell all values apart
  double rescaleSlope = 1;
  double densityZero = 0;    ///< Value of 16-bit density 0 (Density16), near which floats are finest
  ValueRange range;          ///< Smallest and largest value
  double p01 = 0, p999 = 0;  ///< P0.1 and P99.9 of picture.md 5
  std::optional<Window> fileWindow;
  std::shared_ptr<const BlockRanges> blockRanges;  ///< Null if unknown: every block counts
  std::vector<float> gradientBounds;               ///< Result of gradientBoundsOf(); empty if unknown
  Cut cut;                                         ///< Copy of VolumeAttributes::cut
};

/// Returns the facts of a volume. Runs one pass each for block ranges, slopes and percentiles, on all cores.
VolumeFacts factsOf(const Volume& volume);

/// Returns (P99.9 - P0.1) / 32 / cbrt(|det L|), value per mm (picture.md 5).
double defaultGradientFloor(const VolumeFacts& facts);
/// Returns the same with `valueSpread` for P99.9 - P0.1.
double defaultGradientFloor(double valueSpread, const VoxelGeometry& geometry);

}  // namespace volumen
