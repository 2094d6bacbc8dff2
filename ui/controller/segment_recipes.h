#pragma once

#include <vector>

#include "ui/controller/segment_jobs.h"
#include "viewer/recipe/recipe.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// Use of a recipe's segments: `add` makes new ones beside those of the series. `again` replaces the voxels
/// of segments with the same name, if the recipe was recorded from them (segment_record.h).
enum class RecipeUse { add, again };

/// Returns the work that runs a recipe, as one undo step. Its segments get no masked voxels and no voxels of
/// locked segments.
SegmentWork workOf(const Recipe& recipe, const SeriesKey& series, VolumePtr volume, const Mask& mask,
                   RecipeUse use = RecipeUse::add);

}  // namespace volumen
