#pragma once

#include <vector>

#include "viewer/scene/scene.h"

namespace volumen {

/// A named set of lights, all in camera space.
struct LightPreset {
  const char* name;
  std::vector<Light> lights;
};

/// Returns headlight, over the shoulder, three-point and rim.
const std::vector<LightPreset>& lightPresets();

}  // namespace volumen
