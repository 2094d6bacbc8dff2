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

/// One label per voxel of a grid; 0 is background. Voxels are held in bricks; bricks with a single label
/// store no voxels. A LabelMap is immutable. LabelEdit derives a new map that shares all unchanged bricks, so
/// that an undo step costs only what it changed.
class LabelMap {
 public:
  static constexpr int edge = 32;  ///< Brick edge in voxels
  /// Labels of a brick, i fastest; 0 beyond the grid.
  using Voxels = std::array<std::uint8_t, std::size_t(edge) * edge * edge>;

  /// Creates a map that is all background.
  explicit LabelMap(const VoxelGeometry& geometry);
  /// Runs on all cores.
  explicit LabelMap(const DenseLabels& dense);

  const VoxelGeometry& geometry() const { return geometry_; }
  /// Returns the label of a voxel in the grid.
  std::uint8_t at(glm::ivec3 voxel) const;
  /// Writes the size.x labels of the voxels (0.., j, k).
  void readRow(int j, int k, std::uint8_t* labels) const;
  /// Returns all labels in one array. Runs on all cores.
  DenseLabels dense() const;

  /// Number of bricks along each axis; brick(n) counts them i fastest.
  glm::ivec3 bricks() const { return bricks_; }
  struct Brick {
    std::uint8_t label = 0;                ///< Label of all voxels if `voxels` is null
    std::shared_ptr<const Voxels> voxels;  ///< Null if all voxels have the same label
    /// Creates a brick from voxels, of which the first `size` lie in the grid.
    static Brick of(std::shared_ptr<const Voxels> voxels, glm::ivec3 size);
    bool operator==(const Brick& other) const;
  };
  /// Creates a map of the bricks of another one on this grid.
  LabelMap(const VoxelGeometry& geometry, std::vector<Brick> bricks) : LabelMap(geometry) {
    held_ = std::move(bricks);
  }
  const Brick& brick(std::size_t n) const { return held_[n]; }

  /// Returns the memory of the bricks' voxels in bytes, including bricks shared with other maps.
  std::size_t bytes() const;
  /// True if grids and labels are equal.
  bool operator==(const LabelMap& other) const;

 private:
  friend class LabelEdit;
  friend LabelMap withLabel(const LabelMap&, std::uint8_t, const BitMask&, std::span<const std::uint8_t>);
  std::size_t brickOf(glm::ivec3 voxel) const;
  /// Returns the part of a brick that lies in the grid, in voxels.
  glm::ivec3 sizeOf(std::size_t brick) const;

  VoxelGeometry geometry_;
  glm::ivec3 bricks_;
  std::vector<Brick> held_;
};

/// Returns whether both maps have the same grid and the same voxels of `label`. Shared bricks are not read.
bool holdSame(const LabelMap& a, const LabelMap& b, std::uint8_t label);

/// Returns the number of voxels of each label.
std::array<std::int64_t, 256> labelCounts(const LabelMap& map);

/// Derives a new label map by writing voxels. Not thread-safe.
class LabelEdit {
 public:
  explicit LabelEdit(const LabelMap& map) : map_(map), written_(map.held_.size()) {}

  /// Returns the current label of a voxel.
  std::uint8_t at(glm::ivec3 voxel) const;
  void set(glm::ivec3 voxel, std::uint8_t label);
  /// Returns the map with all changes so far.
  LabelMap done() const;

 private:
  LabelMap map_;
  std::vector<std::unique_ptr<LabelMap::Voxels>> written_;  // null if the brick is unchanged
};

}  // namespace volumen
