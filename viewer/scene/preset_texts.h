#pragma once

#include <string>
#include <vector>

namespace volumen {

/// The files of resources/presets as they are, in alphabetical order of their names. Generated when building.
const std::vector<std::string>& presetTexts();

}  // namespace volumen
