#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// Returns the text (JSON) of a recipe without parsing it. The Error names the file.
Result<std::string> recipeText(const std::string& path);

}  // namespace volumen
