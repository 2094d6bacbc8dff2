#include "results/pictures/reduced_copy.h"

#include <algorithm>

#include "viewer/render/memory_need.h"
#include "viewer/volume/available_memory.h"
#include "viewer/volume/reduced.h"

namespace volumen {

namespace {

constexpr int largestFactor = 8;

std::string sentenceOf(int factor, const std::string& tooLittle) {
  const std::string edge = std::to_string(factor);
  return "Drawn from a reduced copy: each voxel is the mean of " + edge + " x " + edge + " x " + edge + ". " +
         tooLittle;
}

}  // namespace

Result<std::optional<ReducedCopy>> copyToDraw(const Plan& plan, const Volume& volume,
                                              const VolumeFacts& facts, const std::string& name,
                                              std::uint64_t letGo) {
  const auto toDraw = [&](const VoxelGeometry& grid) { return bytesToDraw(plan, grid, volume.stored()); };
  const Status whole = checkAvailable(name + ": drawing all of it", leastBytesToDraw(plan, volume, facts));
  if (whole) return std::optional<ReducedCopy>();
  const std::uint64_t sampleBytes = volume.bytes() / std::uint64_t(volume.geometry().voxelCount());
  for (int factor = 2; factor <= largestFactor; ++factor) {
    const VoxelGeometry grid = reducedGeometry(volume.geometry(), factor);
    const std::uint64_t copy = sampleBytes * std::uint64_t(grid.voxelCount()), all = copy + toDraw(grid);
    if (!isAvailable(copy) || !isAvailable(all - std::min(all, letGo))) continue;
    return std::optional(ReducedCopy{reducedVolume(volume, factor), factor,
                                     Warning(sentenceOf(factor, whole.message()), WarningKind::reduced)});
  }
  return whole.error();
}

}  // namespace volumen
