#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// From a row of voxels to another that touches it: voxels of both touch whose i differ by at most `reach`.
struct RowStep {
  int dj, dk, reach;
};

/// Voxels of a mask side by side in a row, [begin, end), and the part that they are of.
struct VoxelRun {
  int begin, end;
  std::uint32_t part;
};

/// All runs of a mask, row after row, and which are joined by steps. Parts are numbered by their first
/// voxels.
struct JoinedRuns {
  std::vector<VoxelRun> runs;
  std::vector<std::size_t> firstOfRow;  ///< of row j + size.y k; and the number of runs
  std::uint32_t parts = 0;
};

/// By union-find, in slabs on all cores. The steps lead to rows that are earlier in memory, dk is 0 or -1.
/// Of a cancelled one there are no runs.
JoinedRuns joinedRuns(const BitMask& mask, std::span<const RowStep> steps, const CancelToken& cancel);

/// The voxels of the parts that are chosen.
BitMask maskOfRuns(const JoinedRuns& joined, const VoxelGeometry& geometry, const std::vector<bool>& chosen);

}  // namespace volumen
