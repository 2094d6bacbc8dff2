#pragma once

#include <string>
#include <vector>

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// A scene that adapts to the volume it is made for.
struct LevelScene {
  const char* name;
  Scene (*make)(const Volume& volume);
};

/// Returns scenes for judging the levels. They are independent of those that the levels' steps were tuned on.
const std::vector<LevelScene>& levelScenes();

/// Returns the volumes for each scene: names of phantoms, or paths inside the real test data.
const std::vector<std::string>& levelVolumes();
/// Loads a volume, once. Returns null if the real data are absent.
VolumePtr levelVolume(const std::string& name);

}  // namespace volumen::tests
