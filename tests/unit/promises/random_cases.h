#pragma once

#include <cstdint>
#include <string>

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// Families of random cases.
enum class Family {
  pieces,  ///< boxes of the real test data in typical scenes
  hard,    ///< tiny volumes with values, grids, curves and lights at the limits of numerical range
  attack,  ///< thirty kinds of scenes chosen to break levels: lattices, thin things, far numbers
  hostile  ///< scenes whose errors a pilot may miss: narrow peaks, resonance with steps, small details
};
inline constexpr Family families[] = {Family::pieces, Family::hard, Family::attack, Family::hostile};
const char* nameOf(Family family);

/// A volume, a scene and a picture size, drawn at random from a seed.
struct RandomCase {
  std::string what = {};  ///< description of the volume
  VolumePtr volume = {};
  Scene scene = {};
  glm::ivec2 size{32, 32};  ///< 24 .. 32 pixels an edge
};

/// Returns the same case on every machine. It has no volume if that needs absent real test data.
RandomCase randomCase(Family family, std::uint64_t seed);

}  // namespace volumen::tests
