#pragma once

#include <memory>

#include "viewer/volume/block_ranges.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// What the planner's rules may ask of a volume: a value, so that tests can invent one.
struct VolumeFacts {
  VoxelGeometry geometry;
  bool integers = true;  ///< stored as 8- or 16-bit integers that tell the values apart
  double rescaleSlope = 1;
  double densityZero = 0;    ///< the value whose 16-bit density is 0 (Density16): near it floats are finest
  ValueRange range;          ///< smallest and largest value
  double p01 = 0, p999 = 0;  ///< P0.1 and P99.9 of picture.md 5
  std::optional<Window> fileWindow;
  std::shared_ptr<const BlockRanges> blockRanges;  ///< null: unknown, every block counts
  std::vector<float> gradientBounds;               ///< gradientBoundsOf the volume; empty: unknown
  Cut cut;                                         ///< VolumeAttributes::cut
};

/// Reads the facts off a volume (one pass over it each for blockRanges, slopes and percentiles, on all
/// cores).
VolumeFacts factsOf(const Volume& volume);

/// (P99.9 - P0.1) / 32 / cbrt(|det L|), value per mm (picture.md 5).
double defaultGradientFloor(const VolumeFacts& facts);
/// The same for P99.9 - P0.1.
double defaultGradientFloor(double valueSpread, const VoxelGeometry& geometry);

}  // namespace volumen
