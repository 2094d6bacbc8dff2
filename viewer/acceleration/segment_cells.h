#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "viewer/volume/occupancy_field.h"

namespace volumen {

/// Through which cells of an occupancy field its surface goes: bits of blocks of 4 x 4 x 4 cells, and which
/// blocks hold any: bits of regions of 4 x 4 x 4 blocks. Cell (i, j, k) lies between the voxels (i, j, k) and
/// (i, j, k) + 1 of the field's box. A value that never changes.
class SegmentCells {
 public:
  static constexpr int edge = 4;  ///< of a block, cells; of a region, blocks
  static constexpr float level = 0.5f;

  /// On all cores. Of a field of no voxels there are no cells.
  explicit SegmentCells(std::shared_ptr<const OccupancyField> field);

  const std::shared_ptr<const OccupancyField>& field() const { return field_; }
  /// The bit of the n-th of something in a word: i + 4 j + 16 k of the lowest two bits of each.
  static std::uint64_t bitOf(glm::ivec3 n) {
    return std::uint64_t(1) << ((n.x & 3) | (n.y & 3) << 2 | (n.z & 3) << 4);
  }
  std::uint64_t block(glm::ivec3 block) const { return blocks_[at(block, blockCount_)]; }
  std::uint64_t region(glm::ivec3 region) const { return regions_[at(region, regionCount_)]; }
  /// The smallest box of cells that holds all of them; none: high < low.
  const VoxelBox& box() const { return box_; }
  std::size_t bytes() const { return (blocks_.size() + regions_.size()) * sizeof(blocks_[0]); }

 private:
  static std::size_t at(glm::ivec3 n, glm::ivec3 count) {
    return (std::size_t(n.z) * std::size_t(count.y) + std::size_t(n.y)) * std::size_t(count.x) +
           std::size_t(n.x);
  }
  void findCells();
  void findRowOfBlocks(int j, int k);
  void findRegions();

  std::shared_ptr<const OccupancyField> field_;
  glm::ivec3 blockCount_{0}, regionCount_{0};
  std::vector<std::uint64_t> blocks_, regions_;
  VoxelBox box_{glm::ivec3(0), glm::ivec3(-1)};
};

}  // namespace volumen
