#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "viewer/volume/occupancy_field.h"

namespace volumen {

/// The cells of an occupancy field that its surface passes through, as bits of blocks of 4 x 4 x 4 cells.
/// Also holds the distance of each block from such cells. Cell (i, j, k) lies between the voxels (i, j, k)
/// and (i, j, k) + 1 of the field's box. Immutable.
class SegmentCells {
 public:
  static constexpr int edge = 4;  ///< Edge of a block, in cells.
  static constexpr float level = 0.5f;

  /// Uses all cores. A field without voxels has no cells.
  explicit SegmentCells(std::shared_ptr<const OccupancyField> field);

  const std::shared_ptr<const OccupancyField>& field() const { return field_; }
  /// Returns the bit of a cell in the word of its block.
  static std::uint64_t bitOf(glm::ivec3 cell) {
    return std::uint64_t(1) << ((cell.x & 3) | (cell.y & 3) << 2 | (cell.z & 3) << 4);
  }
  std::uint64_t block(glm::ivec3 block) const { return blocks_[at(block, blockCount_)]; }
  /// Returns the Chebyshev distance, in blocks, to the nearest block with such cells. 254 stands for 254 or
  /// more.
  int distance(glm::ivec3 block) const { return distances_[at(block, blockCount_)]; }
  /// Returns the box of the blocks with such cells, in cells. high < low if there are none.
  const VoxelBox& box() const { return box_; }
  std::size_t bytes() const { return blocks_.size() * sizeof(blocks_[0]) + distances_.size(); }

 private:
  static std::size_t at(glm::ivec3 n, glm::ivec3 count) {
    return (std::size_t(n.z) * std::size_t(count.y) + std::size_t(n.y)) * std::size_t(count.x) +
           std::size_t(n.x);
  }
  void findCells();
  void findRowOfBlocks(int j, int k);
  void findBox();
  void findDistances();

  std::shared_ptr<const OccupancyField> field_;
  glm::ivec3 blockCount_{0};
  std::vector<std::uint64_t> blocks_;
  std::vector<std::uint8_t> distances_;
  VoxelBox box_{glm::ivec3(0), glm::ivec3(-1)};
};

}  // namespace volumen
