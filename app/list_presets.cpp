#include "app/list_presets.h"

#include <iostream>

#include "app/command.h"
#include "results/pictures/own_presets.h"
#include "viewer/scene/presets.h"

namespace volumen {

void addListPresets(CLI::App& app) {
  const auto list = [] {
    std::cout << "auto\n";
    for (const std::string& name : presetNames()) std::cout << name << '\n';
    for (const Preset& preset : ownPresets().presets) std::cout << printable(preset.name) << '\n';
    throw CLI::Success();
  };
  app.add_flag_callback("--list-presets", list, "List the names of all presets");
}

}  // namespace volumen
