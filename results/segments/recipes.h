#pragma once

#include <string>
#include <vector>

#include "viewer/recipe/recipe.h"
#include "viewer/volume/result.h"

namespace volumen {

struct Series;

/// Reads a recipe file (JSON). The Error names the file.
Result<Recipe> recipeFromFile(const std::string& path);
/// Writes a recipe file. The Error names the file.
Status writeRecipe(const std::string& path, const Recipe& recipe);

/// Returns the built-in recipes for a modality ("CT"), in the order of a menu. Empty without a modality or if
/// it has no recipes.
std::vector<const Recipe*> recipesFor(const std::string& modality);

/// Returns sentences to show before a recipe runs on a series. They say that it is for another modality, or
/// needs a contrast agent that the header does not name.
std::vector<std::string> notesOf(const Recipe& recipe, const Series& series);

}  // namespace volumen
