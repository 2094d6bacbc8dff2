#pragma once

#include <string>

#include "viewer/scene/scene.h"

namespace volumen {

/// Reads and validates a scene file (picture.md 8, JSON in UTF-8). The Error is one sentence that names the
/// field, such as "lights[2].intensity must be >= 0, not -1". Unknown fields are refused.
Result<Scene> sceneFromJson(const std::string& text);

/// Returns the complete scene with every field, in the order of picture.md 8. sceneFromJson(sceneToJson(s))
/// == s for every valid scene.
std::string sceneToJson(const Scene& scene);

/// Validates a scene made in code by the rules for files. The Error names the field.
Status validateScene(const Scene& scene);

}  // namespace volumen
