#pragma once

#include <string>

#include "viewer/recipe/recipe.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Reads a recipe file (JSON). The Error names the file.
Result<Recipe> recipeFromFile(const std::string& path);
/// Writes a recipe file. The Error names the file.
Status writeRecipe(const std::string& path, const Recipe& recipe);

}  // namespace volumen
