#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/fixtures/grids.h"
#include "viewer/segment/bit_mask.h"

namespace volumen::tests {

/// Returns a random small grid of any shape in grids.h, including thick slices. It has up to `most` voxels
/// along each axis, sometimes a single one. Rows end within a word, at its end and beyond it.
inline VoxelGeometry anyGrid(std::mt19937& random, glm::ivec3 most = {70, 9, 7}) {
  VoxelGeometry grid;
  for (int axis = 0; axis < 3; ++axis)
    grid.size[axis] = random() % 8 == 0 ? 1 : 1 + int(random() % unsigned(most[axis]));
  if (random() % 6 == 0) grid.size.x = std::min(64, most.x);
  const std::size_t shape = random() % (std::size(grids) + std::size(thickGrids));
  grid.patientFromVoxelStep =
      (shape < std::size(grids) ? grids[shape] : thickGrids[shape - std::size(grids)]).patientFromVoxelStep;
  grid.origin = {-3, 5, 0.25};
  return grid;
}

/// Returns random voxels of any density, including none and all, sometimes in blocks.
inline BitMask anyMask(std::mt19937& random, const VoxelGeometry& grid) {
  BitMask mask(grid);
  const unsigned ofHundred = unsigned(std::vector{0, 3, 20, 35, 50, 70, 90, 100}[random() % 8]);
  const bool blocks = random() % 3 == 0;
  const glm::ivec3 edge =
      blocks ? glm::ivec3(1 + random() % 9, 1 + random() % 3, 1 + random() % 3) : glm::ivec3(1);
  const auto seed = unsigned(random());
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) {
        std::minstd_rand block{seed + unsigned(i / edge.x + 97 * (j / edge.y) + 9973 * (k / edge.z)) * 7919u};
        block();
        if ((blocks ? block() >> 5 : random()) % 100 < ofHundred) mask.set({i, j, k});
      }
  return mask;
}

/// Returns all voxels of a grid in memory order.
inline std::vector<glm::ivec3> voxelsOf(const VoxelGeometry& grid) {
  std::vector<glm::ivec3> all;
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i) all.emplace_back(i, j, k);
  return all;
}

inline bool isInGrid(glm::ivec3 v, glm::ivec3 size) {
  return v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < size.x && v.y < size.y && v.z < size.z;
}

/// Returns the part of a mask that a flood fill reaches from the voxels `open` by `steps`.
inline BitMask reachedFrom(std::vector<glm::ivec3> open, const BitMask& mask,
                           const std::vector<glm::ivec3>& steps) {
  BitMask reached(mask.geometry());
  const auto reach = [&](glm::ivec3 v) {
    if (!isInGrid(v, mask.size()) || !mask.at(v) || reached.at(v)) return;
    reached.set(v);
    open.push_back(v);
  };
  for (const glm::ivec3 start : std::exchange(open, {})) reach(start);
  while (!open.empty()) {
    const glm::ivec3 v = open.back();
    open.pop_back();
    for (const glm::ivec3 step : steps) reach(v + step);
  }
  return reached;
}

/// Returns steps in both directions along all axes but `axis` (-1: along all axes).
inline std::vector<glm::ivec3> stepsAcross(int axis) {
  std::vector<glm::ivec3> steps;
  for (int a = 0; a < 3; ++a) {
    glm::ivec3 step(0);
    step[a] = 1;
    if (a != axis) steps.insert(steps.end(), {step, -step});
  }
  return steps;
}

/// Returns the mask with its holes, which a flood fill from the border does not reach. Holes are in slices
/// across `axis`, or in space (-1).
inline BitMask filledSlowly(const BitMask& mask, int axis) {
  std::vector<glm::ivec3> border;
  for (const glm::ivec3 v : voxelsOf(mask.geometry()))
    for (int a = 0; a < 3; ++a)
      if (a != axis && (v[a] == 0 || v[a] == mask.size()[a] - 1)) border.push_back(v);
  return inverted(reachedFrom(border, inverted(mask), stepsAcross(axis)));
}

/// Returns whether a mask holds exactly the voxels for which holds(voxel), and no bits beyond the grid.
template <class Holds>
bool isExactly(const BitMask& mask, const Holds& holds) {
  BitMask twin(mask.geometry());
  for (const glm::ivec3 voxel : voxelsOf(mask.geometry())) twin.set(voxel, holds(voxel));
  return twin == mask;
}

/// Returns the description of a failed case.
inline std::string caseOf(int seed, const BitMask& mask) {
  const glm::ivec3 size = mask.size();
  return "seed " + std::to_string(seed) + ": " + std::to_string(size.x) + " x " + std::to_string(size.y) +
         " x " + std::to_string(size.z) + ", " + std::to_string(mask.count()) + " voxels";
}

}  // namespace volumen::tests
