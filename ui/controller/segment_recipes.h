#pragma once

#include <vector>

#include "ui/controller/segment_jobs.h"
#include "viewer/recipe/recipe.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// Returns the built-in recipes for a modality ("CT"), in the order of a menu. Empty without a modality or if
/// it has no recipes.
std::vector<const Recipe*> recipesFor(const std::string& modality);

/// Returns sentences to show before a recipe runs on a series. They say that it is for another modality, or
/// needs a contrast agent that the header does not name.
std::vector<std::string> notesOf(const Recipe& recipe, const Series& series);

/// Use of a recipe's segments: `add` makes new ones beside those of the series. `again` replaces the voxels
/// of segments with the same name, if the recipe was recorded from them (segment_record.h).
enum class RecipeUse { add, again };

/// Returns the work that runs a recipe, as one undo step. Its segments get no masked voxels and no voxels of
/// locked segments.
SegmentWork workOf(const Recipe& recipe, const SeriesKey& series, VolumePtr volume, const Mask& mask,
                   RecipeUse use = RecipeUse::add);

}  // namespace volumen
