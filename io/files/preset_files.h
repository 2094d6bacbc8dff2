#pragma once

#include <string>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// The user's own presets: one file each in $XDG_CONFIG_HOME/volumen/presets (else ~/.config).
std::string presetFolder();
/// Those of hanging protocols lie beside them, in volumen/protocols.
std::string protocolFolder();

struct PresetFile {
  std::string path, text;
};

/// All *.json there, in order of their names; no folder, no files. What is no ordinary file, or larger than a
/// preset can be, is left out.
std::vector<PresetFile> readPresetFiles(const std::string& folder = presetFolder());

/// Writes the text of the preset of this name, in place of one of the same name. An Error names the file.
Status writePresetFile(const std::string& name, const std::string& text,
                       const std::string& folder = presetFolder());
/// An Error where it cannot be deleted.
Status deletePresetFile(const std::string& path);

}  // namespace volumen
