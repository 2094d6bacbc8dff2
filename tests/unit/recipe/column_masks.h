#pragma once

#include <initializer_list>

#include "tests/fixtures/small_volumes.h"
#include "viewer/segment/bit_mask.h"

namespace volumen::tests {

/// Returns 16 x 2 x 2 voxels of 1 mm whose value is their column.
inline VolumePtr sixteen() {
  return volumeOf<std::int16_t>({16, 2, 2}, glm::dmat3(1), [](glm::dvec3 p) { return p.x; });
}
/// Returns a mask of the given columns.
inline BitMask columnsOf(const Volume& volume, std::initializer_list<int> columns) {
  BitMask mask(volume.geometry());
  for (const int i : columns)
    for (int k = 0; k < 2; ++k)
      for (int j = 0; j < 2; ++j) mask.set({i, j, k});
  return mask;
}

}  // namespace volumen::tests
