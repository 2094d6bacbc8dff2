#pragma once

#include <vector>

#include "ui/controller/segment_jobs.h"
#include "viewer/recipe/recipe.h"
#include "viewer/segment/mask.h"

namespace volumen {

/// The built-in recipes that are offered for a modality ("CT"), in the order of a menu; for none, and for
/// those that have none of their own, none.
std::vector<const Recipe*> recipesFor(const std::string& modality);

/// The work that adds a recipe's segments to those of a series: what the mask takes away is in none of them,
/// nor voxels of locked segments.
SegmentWork workOf(const Recipe& recipe, const SeriesKey& series, VolumePtr volume, const Mask& mask);

}  // namespace volumen
