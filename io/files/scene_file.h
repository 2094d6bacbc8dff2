#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// The text of a scene (JSON): that of a scene file, or the one that a PNG of the program carries. The Error
/// names the file: it cannot be read, or it is a picture that holds no scene.
Result<std::string> readSceneText(const std::string& path);

}  // namespace volumen
