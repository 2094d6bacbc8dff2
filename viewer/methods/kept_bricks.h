#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "viewer/plan/plan.h"

namespace volumen {

/// Returns one entry per brick (GradientBricks16), 1 if the plan needs its gradients. Returns nothing if the
/// plan reads all gradients, or if leaving some out saves less than a quarter.
std::optional<std::vector<std::uint8_t>> bricksToKeep(const Plan& plan, const VolumeFacts& facts);

/// Returns the bytes that the kept bricks take in a volume of `size` voxels.
std::uint64_t bytesOfBricks(const std::vector<std::uint8_t>& kept, glm::ivec3 size);

}  // namespace volumen
