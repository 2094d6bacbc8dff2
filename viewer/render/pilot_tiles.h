#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "viewer/plan/plan.h"

namespace volumen {

/// A tile of RayGenerator::tile x RayGenerator::tile pixels whose rays a pilot follows.
struct PilotTile {
  glm::ivec2 corner{0};
  double chance = 1;  ///< Probability of being chosen; it stands for 1 / chance tiles
  bool operator==(const PilotTile&) const = default;
};

/// Returns about a quarter of the tiles of a picture of `size` that `plan` would draw. Half of them are
/// spread evenly; the others lie where values change most along the rays. The volume's blocks tell this, so
/// that nothing larger than a block is missed. The result depends only on the plan and the facts. Its first
/// quarter and half are samples of all tiles.
std::vector<PilotTile> pilotTiles(const Plan& plan, const VolumeFacts& facts, glm::ivec2 size);

}  // namespace volumen
