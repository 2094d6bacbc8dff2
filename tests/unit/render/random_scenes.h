#pragma once

#include <cstdint>

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// A tiny volume, a scene and a picture size, all drawn by chance from a seed.
struct RandomScene {
  VolumePtr volume;
  Scene scene;
  glm::ivec2 size;
};

/// The same on every machine. Grids of 1 to 9 voxels an edge of any affine kind; noise, waves, ramps and
/// plateaus; curves with steps and coinciding points; every mode, camera, clip and light.
RandomScene randomScene(std::uint64_t seed);

}  // namespace volumen::tests
