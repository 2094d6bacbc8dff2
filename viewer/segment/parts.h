#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/segment/runs.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Connectivity: voxels that share a face; or also an edge; or also a corner.
enum class Neighbours { faces = 6, edges = 18, corners = 26 };

/// The connected components of a mask, largest first. Of equal ones, the one with the first voxel in memory
/// comes first.
class Parts {
 public:
  /// Finds the components; none if cancelled.
  Parts(const BitMask& mask, Neighbours neighbours, const CancelToken& cancel = {});

  std::size_t count() const { return sizes_.size(); }
  /// Returns the number of voxels of component `n`.
  std::int64_t size(std::size_t n) const { return sizes_[n]; }
  /// Returns the component of a voxel, or count() if none holds it or it lies beyond the grid.
  std::size_t of(glm::ivec3 voxel) const;
  /// Returns the voxels of all components with chosen[n] set (chosen.size() == count()).
  BitMask mask(const std::vector<bool>& chosen) const;
  BitMask largest(std::size_t count = 1) const;
  /// Returns the components of at least `voxels` voxels.
  BitMask atLeast(std::int64_t voxels) const;
  /// Return the components that hold one of these voxels, and all others.
  BitMask touched(std::span<const glm::ivec3> voxels) const;
  BitMask untouched(std::span<const glm::ivec3> voxels) const;

 private:
  std::vector<bool> holding(std::span<const glm::ivec3> voxels) const;

  VoxelGeometry geometry_;
  JoinedRuns joined_;
  std::vector<std::int64_t> sizes_;
};

/// Returns the components of the mask that hold a seed; empty if no seed is in the mask. Seeds beyond the
/// grid are ignored. The cost grows with the result, not with the grid. The result is incomplete if
/// cancelled.
BitMask connected(const BitMask& mask, std::span<const glm::ivec3> seeds, Neighbours neighbours,
                  const CancelToken& cancel = {});

/// Works like connected(), but does not pass thin bridges. It shrinks the mask by a ball of `radiusMm` and
/// keeps the components that hold a seed, or are the nearest within 2 radiusMm. Then it grows them again by
/// that ball, which stays inside the mask. Unlike opening by reconstruction it does not leak back.
BitMask connectedBeyond(const BitMask& mask, std::span<const glm::ivec3> seeds, Neighbours neighbours,
                        double radiusMm, const CancelToken& cancel = {});

}  // namespace volumen
