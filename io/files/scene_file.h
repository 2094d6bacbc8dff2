#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// The text (JSON) of a scene: all of a scene file, or what a picture of ours (PNG or JPEG) says it was drawn
/// from. It is not looked into. The Error names the file.
Result<std::string> sceneText(const std::string& path);

}  // namespace volumen
