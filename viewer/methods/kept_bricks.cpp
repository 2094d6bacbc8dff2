#include "viewer/methods/kept_bricks.h"

#include <algorithm>

#include "viewer/plan/visibility.h"
#include "viewer/volume/gradient_bricks.h"

namespace volumen {

namespace {

// Returns whether the plan reads gradients of visible cells only. Invisible samples contribute nothing. Other
// methods and operators read whole rows.
bool looksWhereVisible(const Plan& plan, const VolumeFacts& facts) {
  return plan.gradients && plan.bits == 16 && plan.skipBlocks && plan.scene.mode == Mode::composite &&
         plan.resampler == Resampler::cpu &&
         (plan.method == Method::planes || plan.method == Method::blend) &&
         plan.gradientOperator == GradientOperator::sobel && facts.blockRanges &&
         facts.blockRanges->edge <= GradientBricks16::cells;
}

std::vector<std::uint8_t> bricksOf(const std::vector<std::uint8_t>& visible, const BlockRanges& blocks,
                                   glm::ivec3 count) {
  std::vector<std::uint8_t> bricks(std::size_t(count.x) * count.y * count.z);
  const int times = GradientBricks16::cells / blocks.edge;
  std::size_t n = 0;
  for (int k = 0; k < blocks.count.z; ++k)
    for (int j = 0; j < blocks.count.y; ++j)
      for (int i = 0; i < blocks.count.x; ++i)
        bricks[(std::size_t(k / times) * count.y + j / times) * count.x + i / times] |= visible[n++];
  return bricks;
}

}  // namespace

std::optional<std::vector<std::uint8_t>> bricksToKeep(const Plan& plan, const VolumeFacts& facts) {
  if (!looksWhereVisible(plan, facts)) return {};
  const glm::ivec3 size = facts.geometry.size;
  std::vector<std::uint8_t> kept = bricksOf(visibleBlocks(plan.curve, *facts.blockRanges), *facts.blockRanges,
                                            GradientBricks16::countOf(size));
  const std::uint64_t all = 8 * std::uint64_t(facts.geometry.voxelCount());
  constexpr std::uint64_t most = std::uint64_t(1) << 32;  // kernels index bricks with 32 bits
  const std::uint64_t bytes = bytesOfBricks(kept, size);
  if (std::ranges::find(kept, 0) == kept.end() || bytes > all / 4 * 3 || bytes >= most) return {};
  return kept;
}

std::uint64_t bytesOfBricks(const std::vector<std::uint8_t>& kept, glm::ivec3 size) {
  return GradientBricks16::bytesOf(std::ranges::count(kept, 1), GradientBricks16::countOf(size));
}

}  // namespace volumen
