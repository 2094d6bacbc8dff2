#pragma once

#include <string>
#include <vector>

#include "viewer/render/render.h"

namespace volumen::tests {

/// A scene that every method is tried on.
struct MethodScene {
  std::string name;
  Scene scene;
};

/// Integers that wave between -200 and 1200 on an oblique, sheared, anisotropic grid.
VolumePtr wavyVolume(glm::ivec3 size = {26, 22, 18});

/// Lit soft matter in wavyVolume(), seen obliquely.
Scene softScene(Projection projection = Projection::parallel);

/// {parallel, perspective} x {opaque, translucent, lit, unlit, clipped, sharp curve, many lights}, for
/// wavyVolume().
const std::vector<MethodScene>& methodScenes();

/// Plans a picture of the caches' volume and draws it.
Result<Rendered> planAndDraw(RenderCaches& caches, const Scene& scene, const RenderOptions& options,
                             const CancelToken& cancel = {});

/// A method as it is asked for.
struct MethodCase {
  std::string name;
  RenderOptions options;
  bool needsGl = false;
};

/// Every method with every resampler and frame buffer it has; but for the reference.
const std::vector<MethodCase>& methodCases();

}  // namespace volumen::tests
