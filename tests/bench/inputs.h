#pragma once

#include <string>
#include <vector>

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen::bench {

/// What a benchmark is asked: PATH SCENE.json... [--rounds N] [--threads N] [--pictures FOLDER].
struct Arguments {
  std::string path;
  std::vector<std::string> scenes;  ///< at least one
  std::string pictures;             ///< empty: none
  int rounds = 3;
  int threads = 0;  ///< 0: all allowed
};

/// An Error: how it is used.
Result<Arguments> readArguments(int argc, char** argv, bool mayWritePictures);

/// The largest volume of what lies at `path`, as it is drawn.
Result<VolumePtr> readVolume(const std::string& path);

struct NamedScene {
  std::string name;  ///< of its file, without ".json"
  Scene scene;
};

/// An Error names the file.
Result<NamedScene> readScene(const std::string& path);

}  // namespace volumen::bench
