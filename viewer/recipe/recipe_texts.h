#pragma once

#include <string>
#include <vector>

namespace volumen {

/// The files of resources/recipes as they are, in alphabetical order of their names. Generated when building.
const std::vector<std::string>& recipeTexts();

}  // namespace volumen
