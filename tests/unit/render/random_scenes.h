#pragma once

#include <cstdint>

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// A tiny volume, a scene and a picture size, drawn at random from a seed.
struct RandomScene {
  VolumePtr volume;
  Scene scene;
  glm::ivec2 size;
};

/// Returns the same scene on every machine. Grids have 1 to 9 voxels an edge and any affine shape. Values are
/// noise, waves, ramps and plateaus. Curves have steps and coinciding points. All modes, cameras, clips and
/// lights occur.
RandomScene randomScene(std::uint64_t seed);

}  // namespace volumen::tests
