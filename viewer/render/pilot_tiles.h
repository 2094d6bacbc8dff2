#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "viewer/plan/plan.h"

namespace volumen {

/// A tile of RayGenerator::tile x RayGenerator::tile pixels whose rays a pilot follows.
struct PilotTile {
  glm::ivec2 corner{0};
  double chance = 1;  ///< that it is among those chosen: it stands for 1 / chance tiles
  bool operator==(const PilotTile&) const = default;
};

/// About a quarter of the tiles of a picture of `size`, which `plan` would draw. Half of them are spread
/// evenly, the others stand where values change most on the way of the rays: the blocks of the volume tell,
/// so that nothing that is larger than one is overlooked. Of the plan and the facts alone. The first quarter
/// of them are a sample of all.
std::vector<PilotTile> pilotTiles(const Plan& plan, const VolumeFacts& facts, glm::ivec2 size);

}  // namespace volumen
