#pragma once

#include <cstdint>
#include <vector>

#include "viewer/scene/scene.h"

namespace volumen {

/// Converts a kernel's density to real values: real = slope * density + intercept, slope > 0.
struct DensityScale {
  double slope = 1, intercept = 0;
  double low = 0, high = 0;  ///< The range of densities.
};

/// The transfer function over density as the kernels read it: exact and piecewise linear. A density falls
/// into a bucket, which names the first segment it can lie in. At most `hops` comparisons with nodes find the
/// right segment: the number of (different) nodes <= density. By picture.md 4 the last point of a step holds
/// at its value and above.
struct CurveTable {
  static constexpr int buckets = 2048;
  static constexpr int padding = 16;      ///< The segments' arrays are padded to at least this many entries.
  float visibleLow = 0, visibleHigh = 0;  ///< Densities outside this range have opacity 0.
  float low = 0, perBucket = 0;  ///< bucket = clamp(int((density - low) * perBucket), 0, buckets - 1).
  int hops = 0;
  int segments = 0;
  std::vector<std::int32_t> first;          ///< First segment of each bucket.
  std::vector<float> node;                  ///< node[s]: end of segment s; infinity behind the last.
  std::vector<float> start;                 ///< Density from which segment s is counted.
  std::vector<float> opacity, opacityRise;  ///< Opacity at `start`, and its rise per unit of density.
  /// Number of segments with any opacity before segment s, and up to and including it. If `shownBefore` of
  /// the first and `shownUpTo` of the last of several neighbours are equal, none of them has opacity.
  std::vector<float> shownBefore, shownUpTo;
  std::vector<float> red, redRise, green, greenRise, blue, blueRise;
  std::size_t bytes() const;
};

CurveTable makeCurveTable(const TransferFunction& curve, const DensityScale& scale);

}  // namespace volumen
