#pragma once

#include <string>
#include <vector>

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen::bench {

/// Arguments of a benchmark: PATH SCENE.json... [--rounds N] [--threads N] [--pictures FOLDER].
struct Arguments {
  std::string path;
  std::vector<std::string> scenes;  ///< at least one
  std::string pictures;             ///< folder for pictures, empty for none
  int rounds = 3;
  int threads = 0;  ///< 0: all available threads
};

/// Returns the arguments, or an Error with the usage.
Result<Arguments> readArguments(int argc, char** argv, bool mayWritePictures);

/// Returns the largest volume at `path`, as it is drawn.
Result<VolumePtr> readVolume(const std::string& path);

struct NamedScene {
  std::string name;  ///< name of the file without ".json"
  Scene scene;
};

/// Reads a scene. An Error names the file.
Result<NamedScene> readScene(const std::string& path);

}  // namespace volumen::bench
