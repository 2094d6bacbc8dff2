#include "tests/ui/slow_renderer.h"

namespace volumen::tests {

VolumePtr smallVolume(std::int16_t value) {
  VolumeParts parts;
  parts.geometry.size = {4, 4, 4};
  parts.values = std::vector<std::int16_t>(64, value);
  return volumeFrom(std::move(parts));
}

Scene greyScene(double grey) {
  Scene scene;
  scene.camera = Camera{};
  scene.lights[0].intensity = grey;
  return scene;
}

RenderOptions ofSize(int width, int height) {
  RenderOptions options;
  options.size = {width, height};
  return options;
}

}  // namespace volumen::tests
