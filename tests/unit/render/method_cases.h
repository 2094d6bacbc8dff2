#pragma once

#include <string>
#include <vector>

#include "viewer/plan/options.h"
#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// A scene that every method is tried on.
struct MethodScene {
  std::string name;
  Scene scene;
};

/// Integers that wave between -200 and 1200 on an oblique, sheared, anisotropic grid of 26 x 22 x 18.
VolumePtr wavyVolume();

/// {parallel, perspective} x {opaque, translucent, lit, unlit, clipped, sharp curve, many lights}, for
/// wavyVolume().
const std::vector<MethodScene>& methodScenes();

/// A method as it is asked for.
struct MethodCase {
  std::string name;
  RenderOptions options;
  bool needsGl = false;
};

/// Every method with every resampler and frame buffer it has; but for the reference.
const std::vector<MethodCase>& methodCases();

}  // namespace volumen::tests
