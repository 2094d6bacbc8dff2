#pragma once

#include <string>
#include <vector>

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// A scene in the measures of whatever volume it is made for.
struct LevelScene {
  const char* name;
  Scene (*make)(const Volume& volume);
};

/// Scenes for judging the levels, kept apart from those that their steps were chosen on.
const std::vector<LevelScene>& levelScenes();

/// The volumes that each of them is drawn of: phantoms by name, or paths inside the real test data.
const std::vector<std::string>& levelVolumes();
/// One of them, loaded once. Null where the real data are absent.
VolumePtr levelVolume(const std::string& name);

}  // namespace volumen::tests
