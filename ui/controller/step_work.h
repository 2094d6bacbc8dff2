#pragma once

#include <vector>

#include "ui/workspace/segment_map.h"
#include "viewer/recipe/recipe.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// Steps that are to be done on the segments of a map.
struct StepsWanted {
  std::vector<Step> steps;   ///< segments are called as their map's record does (segment_record.h)
  std::vector<int> numbers;  ///< the segments that they come to: each takes its voxels from those before it
  bool areApart = false;     ///< these share no voxel with each other, or with any that no step changes
  NamedMasks given{};        ///< what steps "byHand" of helpers are
};

/// With these steps done, which take voxels from all segments but those of them that are locked, and recorded
/// with what that takes. None of `numbers` may be locked. The Error is that of a step, or "Cancelled.".
Result<SegmentMap> withStepsDone(SegmentMap map, const StepsWanted& wanted, const Volume& volume,
                                 const CancelToken& cancel);

/// What to call, in steps behind these, the voxels that the mask leaves: what makes them is added. Empty
/// where it takes nothing away.
std::string keptName(StepsWanted& wanted, const Volume& volume, const Mask& mask, const CancelToken& cancel);

/// With steps behind them that take from a segment what the mask takes from the volume; from several the
/// same.
StepsWanted keptIn(StepsWanted wanted, const std::vector<std::string>& names, const Volume& volume,
                   const Mask& mask, const CancelToken& cancel);

/// The steps that make of a segment its parts of at least so many ml, each a segment: the largest part, and
/// all that is smaller, stays. `map` gets the new ones. The Error: it has no second such part, or there are
/// more than numbers for them.
Result<StepsWanted> stepsOfSplit(SegmentMap& map, int number, double leastMl, const CancelToken& cancel);

}  // namespace volumen
