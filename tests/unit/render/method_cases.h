#pragma once

#include <string>
#include <vector>

#include "viewer/render/render.h"

namespace volumen::tests {

/// A scene that every method draws.
struct MethodScene {
  std::string name;
  Scene scene;
};

/// Returns integer waves between -200 and 1200 on an oblique, sheared, anisotropic grid.
VolumePtr wavyVolume(glm::ivec3 size = {26, 22, 18});

/// Returns lit soft matter in wavyVolume(), seen obliquely.
Scene softScene(Projection projection = Projection::parallel);

/// Returns {parallel, perspective} x {opaque, translucent, lit, unlit, clipped, sharp curve, many lights} for
/// wavyVolume().
const std::vector<MethodScene>& methodScenes();

/// Plans a picture of the caches' volume and draws it.
Result<Rendered> planAndDraw(RenderCaches& caches, const Scene& scene, const RenderOptions& options,
                             const CancelToken& cancel = {});

/// A method with its options.
struct MethodCase {
  std::string name;
  RenderOptions options;
  bool needsGl = false;
};

/// Returns every method with each of its resamplers and frame buffers, except the reference.
const std::vector<MethodCase>& methodCases();

}  // namespace volumen::tests
