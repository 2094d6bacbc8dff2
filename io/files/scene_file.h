#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// Returns the text (JSON) of a scene file, or the scene embedded in a PNG or JPEG of this program. Does not
/// parse it. The Error names the file.
Result<std::string> sceneText(const std::string& path);

}  // namespace volumen
