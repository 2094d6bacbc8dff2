#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/segment/runs.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Which voxels touch: those that share a face, an edge too, a corner too.
enum class Neighbours { faces = 6, edges = 18, corners = 26 };

/// The connected parts of a mask, in order of size; of equal ones the one whose first voxel is first in
/// memory comes first.
class Parts {
 public:
  /// Of a cancelled one there are none.
  Parts(const BitMask& mask, Neighbours neighbours, const CancelToken& cancel = {});

  std::size_t count() const { return sizes_.size(); }
  /// Voxels of the n-th.
  std::int64_t size(std::size_t n) const { return sizes_[n]; }
  /// The part that holds a voxel; count() where none does, and of a voxel beyond the grid.
  std::size_t of(glm::ivec3 voxel) const;
  /// The voxels of the parts whose number is chosen (chosen.size() == count()).
  BitMask mask(const std::vector<bool>& chosen) const;
  BitMask largest(std::size_t count = 1) const;
  /// Those of at least so many voxels.
  BitMask atLeast(std::int64_t voxels) const;
  /// Those that hold one of these voxels, and all others.
  BitMask touched(std::span<const glm::ivec3> voxels) const;
  BitMask untouched(std::span<const glm::ivec3> voxels) const;

 private:
  std::vector<bool> holding(std::span<const glm::ivec3> voxels) const;

  VoxelGeometry geometry_;
  JoinedRuns joined_;
  std::vector<std::int64_t> sizes_;
};

/// The parts of the mask that hold a seed; empty where none is in it. Costs about what it finds. Seeds beyond
/// the grid are left out. A cancelled one is returned half done.
BitMask connected(const BitMask& mask, std::span<const glm::ivec3> seeds, Neighbours neighbours,
                  const CancelToken& cancel = {});

/// As connected(), but thin bridges let nothing through: of the mask shrunk by a ball of radiusMm the parts
/// that hold a seed (or are the nearest to it within 2 radiusMm), grown again by that ball, which stays
/// inside the mask. Unlike an opening by reconstruction it does not leak back.
BitMask connectedBeyond(const BitMask& mask, std::span<const glm::ivec3> seeds, Neighbours neighbours,
                        double radiusMm, const CancelToken& cancel = {});

}  // namespace volumen
