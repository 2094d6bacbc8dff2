#pragma once

#include <string>
#include <vector>

#include "ui/data/loaded_series.h"
#include "viewer/scene/presets.h"

namespace volumen {

/// The user's own presets, as they lie in files.
struct OwnPresets {
  std::vector<Preset> presets;
  std::vector<std::string> problems;  ///< a sentence for each file that is none
};
OwnPresets ownPresets();

/// A preset in a list.
struct PresetEntry {
  std::string name, modality;
  bool own = false;
};
/// The user's own and those compiled in.
std::vector<PresetEntry> presetEntries();

/// Keeps the look of a scene under a name; values without a unit are kept relative to those of the series. An
/// Error where the name is one of the program's own, or the file cannot be written.
Status saveOwnPreset(const std::string& name, const Scene& scene, const LoadedSeries& series);
Status deleteOwnPreset(const std::string& name);

}  // namespace volumen
