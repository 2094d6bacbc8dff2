#include "ui/panels/light_presets.h"

#include <QtGlobal>

namespace volumen {

namespace {

Light light(glm::dvec3 direction, double intensity, glm::dvec3 colour = glm::dvec3(1)) {
  Light made;
  made.direction = direction;
  made.intensity = intensity;
  made.colour = colour;
  return made;
}

}  // namespace

const std::vector<LightPreset>& lightPresets() {
  static const std::vector<LightPreset> presets{
      {QT_TRANSLATE_NOOP("lights", "Headlight"), {light({0, 0, 1}, 1)}},
      {QT_TRANSLATE_NOOP("lights", "Over the shoulder"),
       {light({-0.5, 0.5, 1}, 1), light({0.8, -0.3, 0.6}, 0.25)}},
      {QT_TRANSLATE_NOOP("lights", "Three-point"),
       {light({-1, 1, 1.5}, 0.8), light({1.5, 0, 1}, 0.35, {0.85, 0.92, 1}), light({0.5, 1, -1.2}, 0.5)}},
      {QT_TRANSLATE_NOOP("lights", "Rim"),
       {light({0, 0, 1}, 0.35), light({-1, 0.3, -0.5}, 0.8), light({1, 0.3, -0.5}, 0.8)}},
  };
  return presets;
}

}  // namespace volumen
