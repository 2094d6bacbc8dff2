#pragma once

#include <cstdint>
#include <string>

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// What random cases are made of.
enum class Family {
  pieces,  ///< boxes out of the real test data, seen as people see them
  hard,    ///< tiny volumes whose values, grids, curves and lights are at the edge of what numbers bear
  attack   ///< thirty kinds of scenes that levels were attacked with: lattices, thin things, far numbers
};
inline constexpr Family families[] = {Family::pieces, Family::hard, Family::attack};
const char* nameOf(Family family);

/// A volume, a scene and a picture size, drawn by chance from a seed.
struct RandomCase {
  std::string what = {};  ///< the volume in words
  VolumePtr volume = {};
  Scene scene = {};
  glm::ivec2 size{32, 32};  ///< 24 .. 32 pixels an edge
};

/// The same on every machine; without a volume where it needs the real test data and they are absent.
RandomCase randomCase(Family family, std::uint64_t seed);

}  // namespace volumen::tests
