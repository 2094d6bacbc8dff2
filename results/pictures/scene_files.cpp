#include "results/pictures/scene_files.h"

#include "io/files/output_file.h"
#include "io/files/scene_file.h"
#include "viewer/scene/scene_json.h"

namespace volumen {

Result<Scene> sceneFromFile(const std::string& path) {
  const auto text = sceneText(path);
  if (!text) return text.error();
  auto scene = sceneFromJson(*text);
  if (!scene) return Error{path + ": " + scene.message()};
  return scene;
}

Status writeScene(const std::string& path, const Scene& scene) {
  return writeWholeFile(path, sceneToJson(scene));
}

}  // namespace volumen
