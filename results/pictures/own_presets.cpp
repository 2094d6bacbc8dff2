#include "results/pictures/own_presets.h"

#include <algorithm>

#include "io/files/preset_files.h"
#include "viewer/scene/automatic.h"

namespace volumen {

OwnPresets ownPresets() {
  OwnPresets own;
  for (const PresetFile& file : readPresetFiles())
    if (Result<Preset> preset = presetFromJson(file.text))
      own.presets.push_back(std::move(*preset));
    else
      own.problems.push_back(file.path + ": " + preset.message());
  return own;
}

std::vector<PresetEntry> presetEntries() {
  std::vector<PresetEntry> entries;
  for (const Preset& preset : ownPresets().presets) entries.push_back({preset.name, preset.modality, true});
  for (const Preset& preset : builtInPresets()) entries.push_back({preset.name, preset.modality, false});
  return entries;
}

Status saveOwnPreset(const std::string& name, const Scene& scene, const LoadedSeries& series) {
  const std::vector<std::string>& taken = presetNames();
  if (name == "auto" || std::find(taken.begin(), taken.end(), name) != taken.end())
    return Error{"\"" + name + "\" is a preset of the program; choose another name."};
  Preset preset{name, series.series.modality, scene, {}};
  preset.scene.camera.reset();
  preset.scene.clip = {};
  if (series.usual && series.usual->low < series.usual->high)
    preset.anchor = series.usual;
  else if (preset.modality == "CT")
    moveValues(preset.scene, -waterOf(*series.volume));
  return writePresetFile(name, presetToJson(preset));
}

Status deleteOwnPreset(const std::string& name) {
  for (const PresetFile& file : readPresetFiles()) {
    const Result<Preset> preset = presetFromJson(file.text);
    if (!preset || preset->name != name) continue;
    if (Status deleted = deletePresetFile(file.path); !deleted) return deleted;
  }
  return {};
}

}  // namespace volumen
