#pragma once

#include "viewer/segment/label_map.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

struct SeedGrowth {
  /// What a mm of path costs, as a share of the range of values (P0.1 to P99.9); 0: only values count.
  double locality = 0.002;
  /// mm around the box of the seeds in which is grown; infinite: everywhere.
  double marginMm = 20;
  bool operator==(const SeedGrowth&) const = default;
};

/// Each voxel takes the label of the seed from which the cheapest path of faces leads to it; a step costs
/// the difference of values plus locality times its length in mm. Background (0) in `seeds` is what is to be
/// found; where the margin ends it stays. Of paths of one cost the smaller label wins, so that the bytes
/// depend on no order. Bucketed shortest paths (Dial 1969). The Error: fewer than two labels, or cancelled.
Result<LabelMap> grownFromSeeds(const Volume& volume, const LabelMap& seeds, const SeedGrowth& growth,
                                const CancelToken& cancel = {});

}  // namespace volumen
