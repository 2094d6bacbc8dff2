#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/scene/scene.h"

namespace volumen {

/// How values are shown: a scene without a view. `anchor`: values without a unit (MR) are moved so that `low`
/// falls on a volume's P1 and `high` on its P99.5. Without one those of CT are Hounsfield units.
struct Preset {
  std::string name, modality;
  Scene scene;
  std::optional<ValueRange> anchor;
};

/// Those compiled in from resources/presets, in the order of a menu.
const std::vector<Preset>& builtInPresets();
/// Their names; "auto" is not among them.
const std::vector<std::string>& presetNames();

/// Whether there is such a preset ("auto" and the user's `own` included); the Error suggests a name that is
/// spelled like it.
Status checkPreset(const std::string& name, const std::vector<Preset>& own = {});

/// A preset file: {"name", "modality", "anchor"?, "scene": what differs from picture.md 8's defaults}. An
/// Error is a sentence that names the field.
Result<Preset> presetFromJson(const std::string& text);
/// The file of a preset; camera and clip are left out.
std::string presetToJson(const Preset& preset);

/// Moves all that stands at values, up by so much.
void moveValues(Scene& scene, double by);
/// The preset's scene for this volume; of a CT without its rescale moved to where its water is (waterOf).
/// Camera and clip are left at their defaults.
Scene sceneOf(const Preset& preset, const Volume& volume);

/// What a preset is, of two scenes: mode, window, curve, shading, lights and background, but not the view.
bool sameLook(const Scene& a, const Scene& b);
/// `scene` with the look of another.
Scene withLook(Scene scene, const Scene& look);

/// The scene of a preset for this volume, of those compiled in and of the user's `own`. "auto" chooses by
/// modality and histogram, and lights over the shoulder. Refused: an unknown name (checkPreset).
Result<Scene> presetScene(const std::string& name, const Volume& volume, const std::vector<Preset>& own = {});

/// The preset that "auto" takes for this volume.
std::string automaticPreset(const Volume& volume);

}  // namespace volumen
