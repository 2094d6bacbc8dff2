#pragma once

#include "viewer/segment/bit_mask.h"
#include "viewer/segment/label_map.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

struct SeedGrowth {
  /// What a mm of path costs, as a share of the range of values (P0.1 to P99.9, or all of it where those are
  /// one); 0: only values count.
  double locality = 0.002;
  /// mm around the box of the seeds in which is grown; infinite: everywhere.
  double marginMm = 20;
  /// Only these voxels are reached, and only labels in them are seeds; all others keep theirs, and nothing
  /// grows through them. Null: all voxels of the grid.
  const BitMask* within = nullptr;
};

/// Costs are whole numbers: so many are the range of values.
inline constexpr int costsOfRange = 16384;

/// Each voxel takes the label of the seed from which the cheapest path of faces leads to it; a step costs
/// the difference of values (rounded to whole costs; values more than 1.5 ranges outside the range count as
/// that far) plus locality times its length in mm (rounded), at least 1. Background (0) in `seeds` is what is
/// to be found; where the margin ends it stays. Of paths of one cost the smaller label wins, so that the
/// bytes depend on no order. Volume and seeds are of one grid. `cancel` hears how far it is. Bucketed
/// shortest paths (Dial 1969), in tiles, on all cores. The Error, in lower case and without a full stop:
/// fewer than two labels, too little memory, or cancelled.
Result<LabelMap> grownFromSeeds(const Volume& volume, const LabelMap& seeds, const SeedGrowth& growth,
                                const CancelToken& cancel = {});

/// The margin of what is grown about seeds, mm: a tenth of the longest edge of their box, and at least three
/// voxels along the axis where those are longest; 0 where there are none.
double marginAboutSeeds(const BitMask& seeds);

}  // namespace volumen
