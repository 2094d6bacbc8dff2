#include "tests/bench/inputs.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/load.h"
#include "io/open.h"
#include "io/study/choose.h"
#include "viewer/scene/scene_json.h"

namespace volumen::bench {

Result<Arguments> readArguments(int argc, char** argv, bool mayWritePictures) {
  Arguments a;
  for (int n = 1; n < argc; ++n) {
    const bool valueFollows = n + 1 < argc;
    if (!std::strcmp(argv[n], "--rounds") && valueFollows)
      a.rounds = std::max(1, std::atoi(argv[++n]));
    else if (!std::strcmp(argv[n], "--threads") && valueFollows)
      a.threads = std::atoi(argv[++n]);
    else if (mayWritePictures && !std::strcmp(argv[n], "--pictures") && valueFollows)
      a.pictures = argv[++n];
    else if (a.path.empty())
      a.path = argv[n];
    else
      a.scenes.push_back(argv[n]);
  }
  if (a.scenes.empty())
    return Error{std::string("usage: PATH SCENE.json... [--rounds N] [--threads N]") +
                 (mayWritePictures ? " [--pictures FOLDER]" : "")};
  return a;
}

Result<VolumePtr> readVolume(const std::string& path) {
  const auto study = openStudy(path);
  if (!study) return study.error();
  const auto chosen = chooseSeries(*study, {});
  if (!chosen) return chosen.error();
  const auto loaded = loadSeries(study->volumes[*chosen]);
  if (!loaded) return loaded.error();
  return loaded->drawn;
}

Result<NamedScene> readScene(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  auto scene = sceneFromJson(text.str());
  if (!scene) return Error{path + ": " + scene.message()};
  return NamedScene{std::filesystem::path(path).stem().string(), std::move(*scene)};
}

}  // namespace volumen::bench
