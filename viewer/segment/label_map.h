#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "viewer/segment/dense_labels.h"
#include "viewer/volume/volume.h"

namespace volumen {

class BitMask;

/// One label a voxel of a grid; 0 is background. It is held in bricks, of which those of one label hold no
/// voxels. A value that never changes: LabelEdit makes another one of it, and both share the bricks that are
/// the same in both, so that a step of undo costs what it changed.
class LabelMap {
 public:
  static constexpr int edge = 32;  ///< of a brick, voxels
  /// i fastest; 0 beyond the grid.
  using Voxels = std::array<std::uint8_t, std::size_t(edge) * edge * edge>;

  /// Background all over.
  explicit LabelMap(const VoxelGeometry& geometry);
  /// On all cores.
  explicit LabelMap(const DenseLabels& dense);

  const VoxelGeometry& geometry() const { return geometry_; }
  /// The label of a voxel of the grid.
  std::uint8_t at(glm::ivec3 voxel) const;
  /// Writes the size.x labels of the voxels (0.., j, k).
  void readRow(int j, int k, std::uint8_t* labels) const;
  /// All of them in one piece; on all cores.
  DenseLabels dense() const;

  /// The bricks: how many along each axis, and one of them (i fastest).
  glm::ivec3 bricks() const { return bricks_; }
  struct Brick {
    std::uint8_t label = 0;                ///< of all its voxels
    std::shared_ptr<const Voxels> voxels;  ///< null where all have that one label; then only
    /// Of these voxels, of which the first `size` lie in the grid.
    static Brick of(std::shared_ptr<const Voxels> voxels, glm::ivec3 size);
    bool operator==(const Brick& other) const;
  };
  const Brick& brick(std::size_t n) const { return held_[n]; }

  /// What the voxels of its bricks take, in bytes; those that it shares with other maps are counted too.
  std::size_t bytes() const;
  /// Whether grid and labels are the same.
  bool operator==(const LabelMap& other) const;

 private:
  friend class LabelEdit;
  friend LabelMap withLabel(const LabelMap&, std::uint8_t, const BitMask&, std::span<const std::uint8_t>);
  std::size_t brickOf(glm::ivec3 voxel) const;
  /// The voxels of a brick that lie in the grid.
  glm::ivec3 sizeOf(std::size_t brick) const;

  VoxelGeometry geometry_;
  glm::ivec3 bricks_;
  std::vector<Brick> held_;
};

/// Whether the grids are the same, and the voxels of a label in both. Bricks that both share are not read.
bool holdSame(const LabelMap& a, const LabelMap& b, std::uint8_t label);

/// How many voxels of the grid have each label.
std::array<std::int64_t, 256> labelCounts(const LabelMap& map);

/// Another label map, made of one by writing voxels. For one thread.
class LabelEdit {
 public:
  explicit LabelEdit(const LabelMap& map) : map_(map), written_(map.held_.size()) {}

  /// The label of a voxel as it is by now.
  std::uint8_t at(glm::ivec3 voxel) const;
  void set(glm::ivec3 voxel, std::uint8_t label);
  /// With all that was set until now.
  LabelMap done() const;

 private:
  LabelMap map_;
  std::vector<std::unique_ptr<LabelMap::Voxels>> written_;  // null: as in map_
};

}  // namespace volumen
