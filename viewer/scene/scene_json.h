#pragma once

#include <string>

#include "viewer/scene/scene.h"

namespace volumen {

/// Reads a scene file (picture.md 8, JSON in UTF-8), validated. Every refusal is one sentence that names the
/// field, e.g. "lights[2].intensity must be >= 0, not -1". Unknown fields are refused.
Result<Scene> sceneFromJson(const std::string& text);

/// The complete scene, every field written, in picture.md 8's order; sceneFromJson(sceneToJson(s)) == s for
/// every valid scene.
std::string sceneToJson(const Scene& scene);

/// Checks a scene made in code by the same rules as a file; the sentence names the field.
Status validateScene(const Scene& scene);

}  // namespace volumen
