#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "viewer/segment/label_map.h"
#include "viewer/volume/volume.h"
#include "viewer/volume/voxel_box.h"

namespace volumen {

/// A set of voxels, one bit each: what the steps of segmentation work on, 64 voxels at once. A row along i is
/// whole words, lowest bit first; bits beyond the grid are 0. Results are the same for any number of threads.
class BitMask {
 public:
  /// None.
  explicit BitMask(const VoxelGeometry& geometry);

  const VoxelGeometry& geometry() const { return geometry_; }
  glm::ivec3 size() const { return geometry_.size; }
  int wordsPerRow() const { return wordsPerRow_; }
  /// The bits of a row's last word that lie in the grid.
  std::uint64_t lastWord() const { return ~std::uint64_t(0) >> (wordsPerRow_ * 64 - geometry_.size.x); }
  /// The words of the voxels (0.., j, k). Who writes keeps bits beyond the grid 0.
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
  /// How many voxels it holds; on all cores.
  std::int64_t count() const;
  bool empty() const;
  /// The smallest box that holds all of them; none where there are none.
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

/// Of two masks of one grid; on all cores.
BitMask united(BitMask a, const BitMask& b);
BitMask intersected(BitMask a, const BitMask& b);
BitMask subtracted(BitMask a, const BitMask& b);
/// All other voxels of the grid.
BitMask inverted(BitMask mask);

/// The voxels of a label; on all cores.
BitMask maskOf(const LabelMap& map, std::uint8_t label);
/// `label` exactly at the voxels of the mask, but none of a locked label (background may be one) is changed;
/// where it was and the mask is not, background. Bricks that stay the same are shared. On all cores.
LabelMap withLabel(const LabelMap& map, std::uint8_t label, const BitMask& mask,
                   std::span<const std::uint8_t> locked = {});

}  // namespace volumen
