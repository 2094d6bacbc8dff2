#include "viewer/render/memory_need.h"

#include "viewer/methods/kept_bricks.h"

namespace volumen {

namespace {

std::uint64_t densityBytes(const Plan& plan, const VoxelValues& type) {
  if (plan.bits == 8) return plan.gradients ? 0 : 1;
  if (plan.bits == 32) return std::holds_alternative<std::vector<float>>(type) ? 0 : 4;
  return std::holds_alternative<std::vector<std::uint8_t>>(type) ? 2 : 0;
}

// In 8 and 16 bits, density and gradient share a word.
std::uint64_t gradientBytes(const Plan& plan) { return plan.gradients ? std::uint64_t(plan.bits) / 2 : 0; }

}  // namespace

std::uint64_t bytesToDraw(const Plan& plan, const VoxelGeometry& geometry, const VoxelValues& type) {
  constexpr std::uint64_t bytesAPixel = 32;
  const std::uint64_t pixels = std::uint64_t(plan.options.size.x) * std::uint64_t(plan.options.size.y);
  const auto voxels = std::uint64_t(geometry.voxelCount());
  if (plan.method == Method::reference) return pixels * bytesAPixel;
  std::uint64_t aVoxel = densityBytes(plan, type) + gradientBytes(plan);
  if (plan.method == Method::preshaded) aVoxel += 4 * sizeof(float);
  // Textures are copies, on most machines in the same memory.
  if (plan.resampler == Resampler::gl) aVoxel += std::uint64_t(plan.bits) / 8 + gradientBytes(plan);
  // Ranges of blocks, the map of empty space and cells.
  const std::uint64_t blocks = voxels / 4;
  return voxels * aVoxel + blocks + pixels * bytesAPixel;
}

std::uint64_t leastBytesToDraw(const Plan& plan, const Volume& volume, const VolumeFacts& facts) {
  const std::uint64_t all = bytesToDraw(plan, volume.geometry(), volume.stored());
  const auto kept = bricksToKeep(plan, facts);
  if (!kept) return all;
  return all - gradientBytes(plan) * std::uint64_t(volume.geometry().voxelCount()) +
         bytesOfBricks(*kept, volume.size());
}

}  // namespace volumen
