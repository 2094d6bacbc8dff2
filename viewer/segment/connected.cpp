#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>
#include <optional>

#include "viewer/segment/bit_rows.h"
#include "viewer/segment/morphology.h"
#include "viewer/segment/parts.h"

namespace volumen {

namespace {

// Returns the steps to all neighbouring rows. Runs in the same row never touch.
std::vector<RowStep> touchingRows(Neighbours neighbours) {
  std::vector<RowStep> steps;
  for (int dk = -1; dk <= 1; ++dk)
    for (int dj = -1; dj <= 1; ++dj) {
      const bool oblique = dj && dk;
      if ((!dj && !dk) || (oblique && neighbours == Neighbours::faces)) continue;
      const bool alsoAlongI =
          neighbours == Neighbours::corners || (!oblique && neighbours == Neighbours::edges);
      steps.push_back({dj, dk, alsoAlongI});
    }
  return steps;
}

bool isIn(glm::ivec3 voxel, glm::ivec3 size) {
  return glm::all(glm::greaterThanEqual(voxel, glm::ivec3(0))) && glm::all(glm::lessThan(voxel, size));
}

// Flood fill from run to run over the rows of a mask; runs are always filled completely.
class Flood {
 public:
  explicit Flood(const BitMask& mask) : mask_(mask), found_(mask.geometry()) {}

  // Adds the runs of a row that meet [begin, end).
  void reach(int begin, int end, int j, int k) {
    const glm::ivec3 size = mask_.size();
    if (j < 0 || k < 0 || j >= size.y || k >= size.z) return;
    const bits::Row in = mask_.row(j, k);
    const auto found = found_.row(j, k);
    end = std::min(end, size.x);
    for (int at = bits::firstSet(in, std::max(begin, 0), end); at < end;) {
      const int last = bits::firstUnset(in, at, size.x);
      if (!bits::isSet(found, at)) {
        const int first = bits::beginOfRun(in, at);
        bits::setRun(found, first, last);
        open_.push_back({first, last, j, k});
      }
      at = bits::firstSet(in, last, end);
    }
  }

  BitMask all(Neighbours neighbours, const CancelToken& cancel) {
    const std::vector<RowStep> steps = touchingRows(neighbours);
    while (!open_.empty() && !cancel.cancelled()) {
      const Open run = open_.back();
      open_.pop_back();
      for (const RowStep step : steps)
        reach(run.begin - step.reach, run.end + step.reach, run.j + step.dj, run.k + step.dk);
    }
    return std::move(found_);
  }

 private:
  struct Open {
    int begin, end, j, k;
  };
  const BitMask& mask_;
  BitMask found_;
  std::vector<Open> open_;
};

// Returns the mask voxel nearest to `to` (of equal ones the first in memory); empty if none lies within
// `mostMm`.
std::optional<glm::ivec3> nearestIn(const BitMask& mask, glm::ivec3 to, double mostMm) {
  const VoxelGeometry& grid = mask.geometry();
  const glm::dmat3 rows = glm::transpose(grid.voxelFromPatientStep());
  glm::ivec3 low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = std::min(mostMm * glm::length(rows[axis]) + 1, 1e9);
    low[axis] = int(std::max(double(to[axis]) - reach, 0.0));
    high[axis] = int(std::min(double(to[axis]) + reach, double(grid.size[axis] - 1)));
  }
  std::optional<glm::ivec3> nearest;
  double least = mostMm;
  for (int k = low.z; k <= high.z; ++k)
    for (int j = low.y; j <= high.y; ++j)
      for (int i = bits::firstSet(mask.row(j, k), low.x, high.x + 1); i <= high.x;
           i = bits::firstSet(mask.row(j, k), i + 1, high.x + 1)) {
        const double mm = glm::length(grid.patientFromVoxelStep * glm::dvec3(glm::ivec3(i, j, k) - to));
        if (nearest ? mm < least : mm <= least) nearest = {i, j, k}, least = mm;
      }
  return nearest;
}

}  // namespace

BitMask connected(const BitMask& mask, std::span<const glm::ivec3> seeds, Neighbours neighbours,
                  const CancelToken& cancel) {
  Flood flood(mask);
  for (const glm::ivec3 seed : seeds)
    if (isIn(seed, mask.size())) flood.reach(seed.x, seed.x + 1, seed.y, seed.z);
  return flood.all(neighbours, cancel);
}

BitMask connectedBeyond(const BitMask& mask, std::span<const glm::ivec3> seeds, Neighbours neighbours,
                        double radiusMm, const CancelToken& cancel) {
  const BitMask core = shrunk(mask, radiusMm, cancel);
  std::vector<glm::ivec3> inCore;
  for (const glm::ivec3 seed : seeds)
    if (isIn(seed, mask.size()))
      if (const auto voxel = nearestIn(core, seed, 2 * radiusMm)) inCore.push_back(*voxel);
  return grown(connected(core, inCore, neighbours, cancel), radiusMm, cancel);
}

}  // namespace volumen
