#include "viewer/segment/morphology.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "viewer/segment/bit_rows.h"
#include "viewer/segment/spread.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Returns the rows of a ball around the origin, cut off at `farthest` voxels along each axis.
std::vector<SpreadRow> ballOf(const VoxelGeometry& grid, double radiusMm, glm::ivec3 farthest) {
  const glm::dmat3& step = grid.patientFromVoxelStep;
  const glm::dmat3 inverseRows = glm::transpose(grid.voxelFromPatientStep());
  const double most = radiusMm * (1 + 1e-9);
  const auto holds = [&](int i, int j, int k) { return glm::length(step * glm::dvec3(i, j, k)) <= most; };
  const auto reach = [&](int axis) {
    return int(std::min(std::floor(radiusMm * glm::length(inverseRows[axis]) + 1), double(farthest[axis])));
  };
  std::vector<SpreadRow> rows;
  for (int k = -reach(2); k <= reach(2); ++k)
    for (int j = -reach(1); j <= reach(1); ++j) {
      const glm::dvec3 middle = step * glm::dvec3(0, j, k);
      const double centre = -glm::dot(step[0], middle) / glm::dot(step[0], step[0]);
      const double away = glm::length(middle + centre * step[0]);
      const double half = std::sqrt(std::max(most * most - away * away, 0.0)) / glm::length(step[0]);
      // This is at most one voxel too many; length() decides.
      int low = int(std::clamp(std::floor(centre - half), -double(farthest.x), double(farthest.x)));
      int high = int(std::clamp(std::ceil(centre + half), -double(farthest.x), double(farthest.x)));
      while (low <= high && !holds(low, j, k)) ++low;
      while (low <= high && !holds(high, j, k)) --high;
      if (low <= high) rows.push_back({j, k, low, high});
    }
  return rows;
}

// Returns the reach of a structuring element along each axis.
glm::ivec3 reachOf(std::span<const SpreadRow> shape) {
  glm::ivec3 reach(0);
  for (const SpreadRow& row : shape)
    reach = glm::max(reach,
                     {std::max(std::abs(row.low), std::abs(row.high)), std::abs(row.dj), std::abs(row.dk)});
  return reach;
}

// Copies the mask to a grid whose first voxel is voxel `corner` of the mask. Voxels outside the mask's grid
// are not set.
BitMask movedOnto(const VoxelGeometry& grid, const BitMask& mask, glm::ivec3 corner) {
  BitMask moved(grid);
  const glm::ivec3 size = grid.size, from = mask.size();
  parallelFor(size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (int k = int(begin); k < int(end); ++k)
      for (int j = 0; j < size.y; ++j) {
        const int otherJ = j + corner.y, otherK = k + corner.z;
        if (otherJ < 0 || otherK < 0 || otherJ >= from.y || otherK >= from.z) continue;
        const auto to = moved.row(j, k);
        for (int n = 0; n < int(to.size()); ++n)
          to[std::size_t(n)] = bits::wordAt(mask.row(otherJ, otherK), n * 64 + corner.x);
        to.back() &= moved.lastWord();
      }
  });
  return moved;
}

VoxelGeometry boxGrid(const VoxelGeometry& grid, const VoxelBox& box) {
  VoxelGeometry part = grid;
  part.size = box.high - box.low + 1;
  part.origin = grid.patientFromVoxel(box.low);
  return part;
}

VoxelBox larger(VoxelBox box, glm::ivec3 by) { return {box.low - by, box.high + by}; }

VoxelBox within(VoxelBox box, glm::ivec3 size) {
  return {glm::max(box.low, glm::ivec3(0)), glm::min(box.high, size - 1)};
}

BitMask shrunkBy(BitMask mask, std::span<const SpreadRow> ball, const CancelToken& cancel) {
  return inverted(spread(inverted(std::move(mask)), ball, cancel));
}

// Runs `work` on the given box of the mask only.
template <class Work>
BitMask inBox(const BitMask& mask, const VoxelBox& box, const Work& work) {
  if (box == VoxelBox{{}, mask.size() - 1}) return work(mask);
  return movedOnto(mask.geometry(), work(movedOnto(boxGrid(mask.geometry(), box), mask, box.low)), -box.low);
}

}  // namespace

BitMask grown(const BitMask& mask, double radiusMm, const CancelToken& cancel) {
  const auto box = mask.box();
  if (!box || !(radiusMm > 0)) return mask;
  const auto ball = ballOf(mask.geometry(), radiusMm, mask.size() - 1);
  return inBox(mask, within(larger(*box, reachOf(ball)), mask.size()),
               [&](const BitMask& part) { return spread(part, ball, cancel); });
}

BitMask shrunk(const BitMask& mask, double radiusMm, const CancelToken& cancel) {
  const auto box = mask.box();
  if (!box || !(radiusMm > 0)) return mask;
  const auto ball = ballOf(mask.geometry(), radiusMm, mask.size() - 1);
  return inBox(mask, within(larger(*box, reachOf(ball)), mask.size()),
               [&](const BitMask& part) { return shrunkBy(part, ball, cancel); });
}

BitMask closed(const BitMask& mask, double radiusMm, const CancelToken& cancel) {
  const auto box = mask.box();
  if (!box || !(radiusMm > 0)) return mask;
  const VoxelGeometry& grid = mask.geometry();
  const glm::ivec3 flat(glm::equal(grid.size, glm::ivec3(1)));
  const auto ball = ballOf(grid, radiusMm, (1 - flat) * glm::max(2 * grid.size, 32));
  // Closing needs the voxels grown beyond the mask's box; the result lies within it.
  const VoxelBox around = larger(*box, reachOf(ball));
  const BitMask before = movedOnto(boxGrid(grid, around), mask, around.low);
  const BitMask after = shrunkBy(spread(before, ball, cancel), ball, cancel);
  return movedOnto(grid, movedOnto(boxGrid(grid, *box), after, box->low - around.low), -box->low);
}

BitMask opened(const BitMask& mask, double radiusMm, const CancelToken& cancel) {
  return grown(shrunk(mask, radiusMm, cancel), radiusMm, cancel);
}

BitMask shell(const BitMask& mask, double radiusMm, const CancelToken& cancel) {
  return subtracted(mask, shrunk(mask, radiusMm, cancel));
}

}  // namespace volumen
