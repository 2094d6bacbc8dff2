// Fuzzes scenes, presets and lists of shapes. A valid scene must be the same after it was written and read.
#include <cstdlib>

#include "viewer/measure/shape_json.h"
#include "viewer/scene/presets.h"
#include "viewer/scene/scene_json.h"

using namespace volumen;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  if (const Result<Scene> scene = sceneFromJson(text)) {
    const Result<Scene> again = sceneFromJson(sceneToJson(*scene));
    if (!again || !(*again == *scene)) std::abort();
  }
  (void)presetFromJson(text);
  (void)shapesFromJson(text);
  return 0;
}
