#pragma once

#include "viewer/segment/bit_mask.h"
#include "viewer/segment/label_map.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

struct SeedGrowth {
  /// Cost of 1 mm of path, as a fraction of the value range (P0.1 to P99.9, or the full range if these are
  /// equal). At 0 only values count.
  double locality = 0.002;
  /// Region to grow in: the bounding box of the seeds plus this margin in mm; infinite means the whole grid.
  double marginMm = 20;
  /// Only these voxels are reached, and only labels in them are seeds. All others keep their label and block
  /// paths. Null means all voxels of the grid.
  const BitMask* within = nullptr;
};

/// Number of integer cost units in the value range.
inline constexpr int costsOfRange = 16384;

/// Grows segments from painted seeds along the path of least intensity change: each voxel gets the label of
/// the seed with the cheapest 6-connected path. A step costs the value difference (rounded; values are
/// clamped to 1.5 ranges outside the range) plus locality times its length in mm (rounded), at least 1. Only
/// background (0) voxels of `seeds` change; outside the margin they stay background.
/// Of equally cheap paths the smaller label wins, so that the result does not depend on the order. Volume and
/// seeds share one grid. `cancel` is told the progress. The algorithm is Dial's bucketed shortest paths
/// (1969), in tiles, on all cores.
/// The Error (lower case, no full stop) means: fewer than two labels, too little memory, or cancelled.
Result<LabelMap> grownFromSeeds(const Volume& volume, const LabelMap& seeds, const SeedGrowth& growth,
                                const CancelToken& cancel = {});

/// Returns the margin for growing around seeds, in mm: a tenth of the longest edge of their bounding box, at
/// least three voxels along the axis with the largest spacing. 0 if there are no seeds.
double marginAboutSeeds(const BitMask& seeds);

}  // namespace volumen
