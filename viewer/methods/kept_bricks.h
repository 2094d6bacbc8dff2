#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "viewer/plan/plan.h"

namespace volumen {

/// Which bricks (GradientBricks16) a plan needs gradients of: one entry a brick. Nothing if it reads all
/// gradients, or leaving some out saves little.
std::optional<std::vector<std::uint8_t>> bricksToKeep(const Plan& plan, const VolumeFacts& facts);

/// What those take.
std::uint64_t bytesOfBricks(const std::vector<std::uint8_t>& kept, glm::ivec3 size);

}  // namespace volumen
