#pragma once

#include <string>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// Returns the folder of the user's settings: $XDG_CONFIG_HOME/volumen (else ~/.config/volumen).
std::string configFolder();
/// Returns the folder of the user's presets in it, one file each: volumen/presets.
std::string presetFolder();
/// Returns the folder of the user's hanging protocols, beside it: volumen/protocols.
std::string protocolFolder();

struct PresetFile {
  std::string path, text;
};

/// Returns all *.json files of a folder, sorted by name; empty if there is no folder. Skips files that are
/// not regular or are too large for a preset.
std::vector<PresetFile> readPresetFiles(const std::string& folder = presetFolder());

/// Writes the text of a preset; replaces one of the same name. The Error names the file.
Status writePresetFile(const std::string& name, const std::string& text,
                       const std::string& folder = presetFolder());
/// Deletes a preset. The Error: it cannot be deleted.
Status deletePresetFile(const std::string& path);

}  // namespace volumen
