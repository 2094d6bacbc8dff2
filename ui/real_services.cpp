#include "results/pictures/own_presets.h"
#include "ui/main_window.h"

namespace volumen {

Services realServices() {
  const auto makeScene = [](const std::string& preset, const Volume& volume) {
    return presetScene(preset, volume, ownPresets().presets);
  };
  return {drawWithCaches, makeScene, presetEntries, userIndexFolder()};
}

}  // namespace volumen
