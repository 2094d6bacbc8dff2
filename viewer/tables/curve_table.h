#pragma once

#include <cstdint>
#include <vector>

#include "viewer/scene/scene.h"

namespace volumen {

/// How a kernel's density relates to real values: real = slope * density + intercept, slope > 0.
struct DensityScale {
  double slope = 1, intercept = 0;
  double low = 0, high = 0;  ///< the range of densities
};

/// The transfer function over density as the kernels read it: exact, piecewise linear. A density falls into a
/// bucket, the bucket names the first segment it can lie in, and at most `hops` comparisons with the nodes
/// find the right one: segment = number of (different) nodes <= density (picture.md 4: the last point of a
/// step holds at the value and above).
struct CurveTable {
  static constexpr int buckets = 2048;
  static constexpr int padding = 16;      ///< the segments' arrays are padded to at least this many entries
  float visibleLow = 0, visibleHigh = 0;  ///< densities outside these have opacity 0
  float low = 0, perBucket = 0;  ///< bucket = clamp(int((density - low) * perBucket), 0, buckets - 1)
  int hops = 0;
  int segments = 0;
  std::vector<std::int32_t> first;          ///< of each bucket
  std::vector<float> node;                  ///< node[s]: end of segment s; infinity behind the last
  std::vector<float> start;                 ///< density from which segment s is counted
  std::vector<float> opacity, opacityRise;  ///< at `start`, and a unit of density
  /// How many segments have any opacity, before segment s and up to it: where the two differ for the first
  /// and the last of some neighbours, none of them has.
  std::vector<float> shownBefore, shownUpTo;
  std::vector<float> red, redRise, green, greenRise, blue, blueRise;
  std::size_t bytes() const;
};

CurveTable makeCurveTable(const TransferFunction& curve, const DensityScale& scale);

}  // namespace volumen
