#pragma once

#include <string>
#include <vector>

#include "viewer/scene/scene.h"

namespace volumen {

/// Names of all presets compiled in from resources/presets, in the order of a menu; "auto" is not among them.
const std::vector<std::string>& presetNames();

/// Whether there is such a preset ("auto" included); the Error suggests a name that is spelled like it.
Status checkPreset(const std::string& name);

/// The scene of a preset for this volume (MR presets are anchored to its percentiles). Camera, clip and
/// background are left at their defaults. "auto" chooses by modality and histogram, and lights over the
/// shoulder. Refused: an unknown name (checkPreset).
Result<Scene> presetScene(const std::string& name, const Volume& volume);

/// The preset that "auto" takes for this volume.
std::string automaticPreset(const Volume& volume);

}  // namespace volumen
