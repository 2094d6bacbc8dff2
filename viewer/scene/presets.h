#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/scene/scene.h"

namespace volumen {

/// Display settings: a scene without a view. With `anchor`, values without a unit (MR) are mapped so that
/// `low` is the volume's P1 and `high` its P99.5. Without it, CT values are Hounsfield units.
struct Preset {
  std::string name, modality;
  Scene scene;
  std::optional<ValueRange> anchor;
};

/// Returns the presets compiled in from resources/presets, in menu order.
const std::vector<Preset>& builtInPresets();
/// Returns the names of the built-in presets, without "auto".
const std::vector<std::string>& presetNames();

/// Returns whether the preset exists ("auto" and the user's `own` included). The Error suggests a similar
/// name.
Status checkPreset(const std::string& name, const std::vector<Preset>& own = {});

/// Reads a preset file: {"name", "modality", "anchor"?, "scene": differences from picture.md 8's defaults}.
/// The Error names the field.
Result<Preset> presetFromJson(const std::string& text);
/// Returns the file of a preset, without camera and clip.
std::string presetToJson(const Preset& preset);

/// Shifts the curve and the window of a scene up by `by`.
void moveValues(Scene& scene, double by);
/// Returns the preset's scene for this volume, shifted to the value of water for CT without its rescale
/// (waterOf). Camera and clip keep their defaults.
Scene sceneOf(const Preset& preset, const Volume& volume);

/// Returns whether two scenes agree in everything a preset holds: mode, window, curve, shading, lights and
/// background, but not the view.
bool sameLook(const Scene& a, const Scene& b);
/// Returns `scene` with these settings of another scene.
Scene withLook(Scene scene, const Scene& look);

/// Returns the scene of a built-in preset or one of the user's `own` for this volume. "auto" chooses by
/// modality and histogram and lights over the shoulder. The Error means an unknown name (checkPreset).
Result<Scene> presetScene(const std::string& name, const Volume& volume, const std::vector<Preset>& own = {});

/// Returns the preset that "auto" selects for this volume.
std::string automaticPreset(const Volume& volume);

}  // namespace volumen
