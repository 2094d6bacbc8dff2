#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "viewer/segment/label_map.h"
#include "viewer/volume/volume.h"
#include "viewer/volume/voxel_box.h"

namespace volumen {

/// A set of voxels, one bit each: segmentation steps process 64 voxels at once. Each row along i starts on a
/// word, lowest bit first; bits beyond the grid are 0. Results are the same for any number of threads.
class BitMask {
 public:
  /// Creates an empty mask.
  explicit BitMask(const VoxelGeometry& geometry);

  const VoxelGeometry& geometry() const { return geometry_; }
  glm::ivec3 size() const { return geometry_.size; }
  int wordsPerRow() const { return wordsPerRow_; }
  /// Returns a word with those bits set that lie in the grid in the last word of a row.
  std::uint64_t lastWord() const { return ~std::uint64_t(0) >> (wordsPerRow_ * 64 - geometry_.size.x); }
  /// Returns the words of the voxels (0.., j, k). Writers must keep bits beyond the grid 0.
  std::span<std::uint64_t> row(int j, int k) { return {words_.data() + firstOf(j, k), wordCount()}; }
  std::span<const std::uint64_t> row(int j, int k) const {
    return {words_.data() + firstOf(j, k), wordCount()};
  }
  std::span<std::uint64_t> words() { return words_; }
  std::span<const std::uint64_t> words() const { return words_; }

  bool at(glm::ivec3 voxel) const {
    return words_[firstOf(voxel.y, voxel.z) + std::size_t(voxel.x) / 64] >> voxel.x % 64 & 1;
  }
  void set(glm::ivec3 voxel, bool in = true);
  /// Returns the number of voxels in the mask. Runs on all cores.
  std::int64_t count() const;
  bool empty() const;
  /// Returns the bounding box of the mask; empty if the mask is empty.
  std::optional<VoxelBox> box() const;
  bool operator==(const BitMask&) const = default;

 private:
  std::size_t wordCount() const { return std::size_t(wordsPerRow_); }
  std::size_t firstOf(int j, int k) const {
    return (std::size_t(k) * std::size_t(geometry_.size.y) + std::size_t(j)) * wordCount();
  }

  VoxelGeometry geometry_;
  int wordsPerRow_;
  std::vector<std::uint64_t> words_;
};

/// Set operations on two masks of one grid. They run on all cores.
BitMask united(BitMask a, const BitMask& b);
BitMask intersected(BitMask a, const BitMask& b);
BitMask subtracted(BitMask a, const BitMask& b);
/// Returns all other voxels of the grid.
BitMask inverted(BitMask mask);

/// Returns the voxels with `label`. Runs on all cores.
BitMask maskOf(const LabelMap& map, std::uint8_t label);
/// Gives `label` to exactly the voxels of the mask; voxels outside it that had the label become background.
/// Voxels of `locked` labels (background may be one) do not change. Unchanged bricks are shared. Runs on all
/// cores.
LabelMap withLabel(const LabelMap& map, std::uint8_t label, const BitMask& mask,
                   std::span<const std::uint8_t> locked = {});

}  // namespace volumen
