#pragma once

#include <string>

#include "viewer/scene/scene.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Reads the scene of a scene file, or of a picture by volumen (PNG or JPEG). The Error names the file.
Result<Scene> sceneFromFile(const std::string& path);
/// Writes a scene file. The Error names the file.
Status writeScene(const std::string& path, const Scene& scene);

}  // namespace volumen
