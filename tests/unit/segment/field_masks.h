#pragma once

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <iterator>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "viewer/segment/bit_mask.h"

namespace volumen::tests {

template <class Work>
void forVoxels(glm::ivec3 size, const Work& work) {
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) work(glm::ivec3(i, j, k));
}

template <class Inside>
BitMask maskWhere(const VoxelGeometry& geometry, const Inside& isIn) {
  BitMask mask(geometry);
  forVoxels(geometry.size, [&](glm::ivec3 v) {
    if (isIn(v)) mask.set(v);
  });
  return mask;
}

/// Returns a random small grid of any shape in `grids`, with at least one voxel an edge. Its rows are
/// sometimes longer than a word of bits.
inline VoxelGeometry anyGrid(Chance& chance, int largest) {
  VoxelGeometry grid;
  for (int a = 0; a < 3; ++a) grid.size[a] = 1 + chance.below(largest);
  if (chance.oneIn(4)) grid.size.x = 60 + chance.below(75);
  grid.patientFromVoxelStep = grids[chance.below(int(std::size(grids)))].patientFromVoxelStep;
  return grid;
}

/// Returns random noise of any density, in which up to three boxes are filled or cleared.
inline BitMask anyMask(Chance& chance, const VoxelGeometry& grid) {
  const double density = chance.oneIn(3) ? 0 : chance.between(0, 1);
  BitMask mask = maskWhere(grid, [&](glm::ivec3) { return chance.share() < density; });
  for (int boxes = chance.below(4); boxes > 0; --boxes) {
    const bool in = chance.oneIn(2);
    const glm::dvec3 size(grid.size), a = chance.colour() * size, b = chance.colour() * size;
    forVoxels(grid.size, [&](glm::ivec3 v) {
      if (glm::all(glm::greaterThanEqual(glm::dvec3(v), glm::min(a, b))) &&
          glm::all(glm::lessThanEqual(glm::dvec3(v), glm::max(a, b))))
        mask.set(v, in);
    });
  }
  return mask;
}

}  // namespace volumen::tests
