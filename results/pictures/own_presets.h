#pragma once

#include <string>
#include <vector>

#include "results/series/loaded_series.h"
#include "viewer/scene/presets.h"

namespace volumen {

/// The user's presets as read from files.
struct OwnPresets {
  std::vector<Preset> presets;
  std::vector<std::string> problems;  ///< a sentence for each file that is no preset
};
OwnPresets ownPresets();

/// A preset in a list.
struct PresetEntry {
  std::string name, modality;
  bool own = false;
};
/// Returns the user's presets and the built-in ones.
std::vector<PresetEntry> presetEntries();

/// Saves the look of a scene under a name. Values without a unit are kept relative to those of the series.
/// Returns an Error if the name is a built-in one or the file cannot be written.
Status saveOwnPreset(const std::string& name, const Scene& scene, const LoadedSeries& series);
Status deleteOwnPreset(const std::string& name);

}  // namespace volumen
