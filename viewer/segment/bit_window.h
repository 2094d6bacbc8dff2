#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/parallel.h"

namespace volumen {

/// Assumption of filters beyond the grid of a mask: no voxels, or copies of the nearest border voxel.
enum class BeyondGrid { nothing, asAtBorder };

/// Returns the box grown by `by` voxels on each side.
inline VoxelBox grownBox(const VoxelBox& box, glm::ivec3 by) { return {box.low - by, box.high + by}; }

/// A copy of the bits in a box of voxels that may reach beyond the grid: the input of a filter for one block.
class BitWindow {
 public:
  void read(const BitMask& mask, const VoxelBox& box, BeyondGrid beyond);
  /// Sets the bits where `labels` equals `label`. `labels` has one entry per voxel of the box.
  void read(std::span<const std::uint8_t> labels, std::uint8_t label, const VoxelBox& box);

  glm::ivec3 size() const { return size_; }
  /// Returns the words of row (j, k) of the box. Bit 0 is the first voxel; bits after the last voxel are 0.
  std::span<const std::uint64_t> row(int j, int k) const {
    return {words_.data() + (std::size_t(k) * std::size_t(size_.y) + std::size_t(j)) * wordsPerRow_,
            wordsPerRow_};
  }
  /// True if all bits are 0 (empty) or all are 1 (full).
  bool empty() const { return !any_; }
  bool full() const { return all_; }

 private:
  void start(const VoxelBox& box);
  void take(std::uint64_t* words);

  glm::ivec3 size_{0};
  std::size_t wordsPerRow_ = 0;
  std::vector<std::uint64_t> words_;
  bool any_ = false, all_ = false;
};

/// Width of a block along i in voxels: one word of a mask.
inline constexpr int blockWidth = 64;

/// Divides a box into blocks and processes them on all cores. Blocks span 64 voxels along i from box.low.x on
/// (the last one too) and up to `edge` along j and k. Each thread's share calls makeWork() once and the
/// result for each of its blocks, so that buffers are reused.
template <class MakeWork>
void forEachBlock(const VoxelBox& box, int edge, const CancelToken& cancel, const MakeWork& makeWork) {
  const glm::ivec3 size = box.high - box.low + 1, step(blockWidth, edge, edge);
  const glm::i64vec3 blocks = (size + step - 1) / step;
  parallelFor(blocks.x * blocks.y * blocks.z, 0, [&](std::int64_t begin, std::int64_t end) {
    auto work = makeWork();
    for (std::int64_t n = begin; n < end && !cancel.cancelled(); ++n) {
      const glm::ivec3 at(n % blocks.x, n / blocks.x % blocks.y, n / blocks.x / blocks.y);
      const glm::ivec3 low = box.low + at * step;
      const glm::ivec3 high = glm::min(low + step - 1, box.high);
      work(VoxelBox{low, {low.x + blockWidth - 1, high.y, high.z}});
    }
  });
}

}  // namespace volumen
