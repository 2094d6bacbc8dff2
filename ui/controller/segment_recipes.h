#pragma once

#include <vector>

#include "ui/controller/segment_jobs.h"
#include "viewer/recipe/recipe.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// The built-in recipes that are offered for a modality ("CT"), in the order of a menu; for none, and for
/// those that have none of their own, none.
std::vector<const Recipe*> recipesFor(const std::string& modality);

/// What is to be said where a recipe is followed on a series: that it is for another modality, or for series
/// with contrast agent, of which the header names none. Sentences.
std::vector<std::string> notesOf(const Recipe& recipe, const Series& series);

/// What becomes of a recipe's segments: others beside those of the series; or, where the recipe was recorded
/// of these (segment_record.h), the voxels of those of the same name.
enum class RecipeUse { add, again };

/// The work that does that, one step: what the mask takes away is in none of them, nor voxels of locked
/// segments.
SegmentWork workOf(const Recipe& recipe, const SeriesKey& series, VolumePtr volume, const Mask& mask,
                   RecipeUse use = RecipeUse::add);

}  // namespace volumen
