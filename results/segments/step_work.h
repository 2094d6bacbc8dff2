#pragma once

#include <vector>

#include "results/segments/segment_map.h"
#include "viewer/recipe/recipe.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// Steps to run on the segments of a map.
struct StepsWanted {
  std::vector<Step> steps;   ///< segments are named as in their map's record (segment_record.h)
  std::vector<int> numbers;  ///< resulting segments; each takes its voxels from those before it
  bool areApart = false;     ///< whether they share no voxel with each other or with any unchanged segment
  NamedMasks given{};        ///< masks of the "byHand" steps of helpers
};

/// Returns the map with these steps run and recorded. They take voxels from all other segments except locked
/// ones; this is recorded too. None of `numbers` may be locked. The Error is that of a step, or "Cancelled.".
Result<SegmentMap> withStepsDone(SegmentMap map, const StepsWanted& wanted, const Volume& volume,
                                 const CancelToken& cancel);

/// Returns an Error of withStepsDone() without the name of the step, which the user did not choose.
std::string withoutStepName(const std::string& why);

/// Adds the steps that make the voxels the mask leaves. Returns their name for later steps, or an empty
/// string if the mask removes nothing.
std::string keptName(StepsWanted& wanted, const Volume& volume, const Mask& mask, const CancelToken& cancel);

/// Returns the steps followed by steps that remove masked voxels from the named segments.
StepsWanted keptIn(StepsWanted wanted, const std::vector<std::string>& names, const Volume& volume,
                   const Mask& mask, const CancelToken& cancel);

/// Returns the steps that turn the parts of a segment of at least `leastMl` into segments. The largest part
/// and all smaller ones stay. `map` gets the new segments. The Error: there is no second such part, or there
/// are more parts than free numbers.
Result<StepsWanted> stepsOfSplit(SegmentMap& map, int number, double leastMl, const CancelToken& cancel);

}  // namespace volumen
