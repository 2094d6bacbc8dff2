#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Step from a row of voxels to a neighbouring row. Voxels of both are neighbours if their i differ by at
/// most `reach`.
struct RowStep {
  int dj, dk, reach;
};

/// A run [begin, end) of mask voxels in a row, and its connected component.
struct VoxelRun {
  int begin, end;
  std::uint32_t part;
};

/// All runs of a mask, row after row, with their components. Components are numbered by their first voxel.
struct JoinedRuns {
  std::vector<VoxelRun> runs;
  /// First run of row j + size.y k; the last entry is the number of runs.
  std::vector<std::size_t> firstOfRow;
  std::uint32_t parts = 0;
};

/// Labels components by union-find, in slabs on all cores. Steps must lead to rows earlier in memory, with dk
/// 0 or -1. Returns no runs if cancelled.
JoinedRuns joinedRuns(const BitMask& mask, std::span<const RowStep> steps, const CancelToken& cancel);

/// Returns the voxels of the chosen components.
BitMask maskOfRuns(const JoinedRuns& joined, const VoxelGeometry& geometry, const std::vector<bool>& chosen);

}  // namespace volumen
