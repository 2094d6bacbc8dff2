#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// The text (JSON) of a recipe. It is not looked into. The Error names the file.
Result<std::string> recipeText(const std::string& path);

}  // namespace volumen
