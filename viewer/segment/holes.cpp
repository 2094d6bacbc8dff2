#include "viewer/segment/holes.h"

#include <array>
#include <cassert>

#include "viewer/segment/runs.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Returns the voxels outside the mask that no steps link to the grid border. The border across axis `open`
// does not count.
BitMask enclosed(const BitMask& mask, std::span<const RowStep> steps, int open, const CancelToken& cancel) {
  const JoinedRuns outside = joinedRuns(inverted(mask), steps, cancel);
  const glm::ivec3 size = mask.size();
  std::vector<bool> inside(outside.parts, true);
  for (std::size_t row = 0; row + 1 < outside.firstOfRow.size(); ++row) {
    const int j = int(row) % size.y, k = int(row) / size.y;
    const bool atBorder =
        (open != 1 && (j == 0 || j == size.y - 1)) || (open != 2 && (k == 0 || k == size.z - 1));
    for (std::size_t n = outside.firstOfRow[row]; n < outside.firstOfRow[row + 1]; ++n) {
      const VoxelRun& run = outside.runs[n];
      if (atBorder || run.begin == 0 || run.end == size.x) inside[run.part] = false;
    }
  }
  return maskOfRuns(outside, mask.geometry(), inside);
}

// Transposes a matrix of 64 x 64 bits (Warren, Hacker's Delight, 7-3).
void transpose(std::array<std::uint64_t, 64>& rows) {
  std::uint64_t half = 0x00000000ffffffff;
  for (std::size_t step = 32; step; step /= 2, half ^= half << step)
    for (std::size_t first = 0; first < 64; first += 2 * step)
      for (std::size_t n = first; n < first + step; ++n) {
        const std::uint64_t swapped = (rows[n] >> step ^ rows[n + step]) & half;
        rows[n] ^= swapped << step;
        rows[n + step] ^= swapped;
      }
}

// Returns the mask with i and j exchanged.
BitMask turned(const BitMask& mask) {
  VoxelGeometry grid = mask.geometry();
  std::swap(grid.size.x, grid.size.y);
  std::swap(grid.patientFromVoxelStep[0], grid.patientFromVoxelStep[1]);
  BitMask made(grid);
  parallelFor(grid.size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    std::array<std::uint64_t, 64> block;
    for (int k = int(begin); k < int(end); ++k)
      for (int to = 0; to < made.wordsPerRow(); ++to)
        for (int from = 0; from < mask.wordsPerRow(); ++from) {
          const int rows = std::min(64, mask.size().y - to * 64),
                    columns = std::min(64, grid.size.y - from * 64);
          block.fill(0);
          for (int n = 0; n < rows; ++n) block[std::size_t(n)] = mask.row(to * 64 + n, k)[std::size_t(from)];
          transpose(block);
          for (int n = 0; n < columns; ++n)
            made.row(from * 64 + n, k)[std::size_t(to)] = block[std::size_t(n)];
        }
  });
  return made;
}

}  // namespace

BitMask holesFilled(const BitMask& mask, const CancelToken& cancel) {
  static constexpr std::array<RowStep, 2> steps{{{-1, 0, 0}, {0, -1, 0}}};
  return united(enclosed(mask, steps, -1, cancel), mask);
}

BitMask holesFilledInSlices(const BitMask& mask, int axis, const CancelToken& cancel) {
  assert(axis >= 0 && axis < 3);
  if (axis == 0) return turned(holesFilledInSlices(turned(mask), 1, cancel));
  const RowStep step = axis == 1 ? RowStep{0, -1, 0} : RowStep{-1, 0, 0};
  return united(enclosed(mask, {&step, 1}, axis, cancel), mask);
}

}  // namespace volumen
