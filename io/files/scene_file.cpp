#include "io/files/scene_file.h"

#include "io/files/picture_text.h"
#include "io/regular_file.h"
#include "io/worker/call.h"

namespace volumen {

namespace {

// A scene is a few kilobytes; in an image file it precedes the pixels.
constexpr std::uint64_t mostSceneBytes = 16 << 20;

// Returns the first bytes of a file. The Error is a reason.
Result<std::vector<std::uint8_t>> beginningOf(const RegularFile& file) {
  std::vector<std::uint8_t> content;
  if (Status s = file.readUpTo(content, mostSceneBytes); !s) return s.error();
  return content;
}

// Returns an empty string if the image holds no scene.
Result<std::string> sceneInPicture(const std::string& path) {
  const auto file = RegularFile::open(path);
  if (!file) return file.error();
  const auto content = beginningOf(*file);
  if (!content) return content.error();
  return textInPicture(*content, "volumen-scene", mostSceneBytes);
}

}  // namespace

Result<std::string> sceneText(const std::string& path) {
  const auto cannotRead = [&](const std::string& why) {
    return Error{"Cannot read the scene " + path + ": " + why + "."};
  };
  const auto file = RegularFile::open(path);
  if (!file) return cannotRead(file.message());
  const auto content = beginningOf(*file);
  if (!content) return cannotRead(content.message());
  if (!isPicture(*content)) {
    if (file->size() > mostSceneBytes) return Error{path + " is no scene: it is larger than 16 MB."};
    return std::string(content->begin(), content->end());
  }
  worker::Request request{.files = {path}, .needBytes = 2 * mostSceneBytes, .mostBytes = 2 * mostSceneBytes};
  worker::Failure failure{};
  const auto scene = worker::isolated<sceneInPicture>(request, failure, path);
  if (!scene) return cannotRead(scene.message());
  if (scene->empty()) return Error{path + " holds no scene."};
  return *scene;
}

}  // namespace volumen
