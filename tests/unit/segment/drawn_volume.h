#pragma once

#include <algorithm>
#include <array>

#include "tests/fixtures/chance.h"
#include "viewer/segment/occupancy.h"

namespace volumen::tests {

/// Returns the part of a cell in which the trilinear field is at least 1/2, by counting lattice points. The
/// lattice is shifted at random in each cell, as else all cells of a flat face would have the same error.
inline double partInside(const OccupancyField& field, glm::ivec3 cell, Chance& chance) {
  const glm::i64vec3 size = field.size();
  std::array<double, 8> v{};
  for (int c = 0; c < 8; ++c) {
    const glm::i64vec3 x = cell + glm::ivec3(c & 1, c >> 1 & 1, c >> 2);
    v[std::size_t(c)] = double(field.values[std::size_t((x.z * size.y + x.y) * size.x + x.x)]);
  }
  if (std::ranges::min(v) >= 0.5) return 1;
  if (std::ranges::max(v) < 0.5) return 0;
  constexpr int n = 10;
  const glm::dvec3 first(chance.share(), chance.share(), chance.share());
  int inside = 0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const glm::dvec3 f = (glm::dvec3(i, j, k) + first) / double(n);
        std::array<double, 4> at{};
        for (std::size_t c = 0; c < 4; ++c) at[c] = v[2 * c] + (v[2 * c + 1] - v[2 * c]) * f.x;
        const double low = at[0] + (at[1] - at[0]) * f.y, high = at[2] + (at[3] - at[2]) * f.y;
        inside += low + (high - low) * f.z >= 0.5;
      }
  return inside / double(n * n * n);
}

/// Returns the volume in mm^3 that pictures draw of a segment (picture.md 10).
inline double drawnVolume(const OccupancyField& field) {
  Chance chance(1);
  double cells = 0;
  const glm::ivec3 size = field.size();
  for (int k = 0; k + 1 < size.z; ++k)
    for (int j = 0; j + 1 < size.y; ++j)
      for (int i = 0; i + 1 < size.x; ++i) cells += partInside(field, {i, j, k}, chance);
  return cells * field.geometry.voxelVolume();
}

}  // namespace volumen::tests
