#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// Smallest and largest value of each block of edge^3 cells. Block (a, b, c) bounds every trilinear value
/// v(x) with edge a <= x < edge (a + 1) (likewise y, z), so it spans the voxels edge a .. edge a + edge; what
/// lies outside the grid is clamped to it. A byte each: the bounds are the next of a few levels that lie
/// outward, so that they take 3 % of densities of 16 bits.
struct BlockRanges {
  static constexpr int mostLevels = 256;
  int edge = 4;  ///< cells: a power of two
  glm::ivec3 count{0};
  std::vector<float> levels;                  ///< real values, ascending
  std::vector<std::uint8_t> lowest, highest;  ///< which level bounds a block's values; i fastest
  std::vector<std::uint32_t> counts;  ///< how many two levels bound: entry lowest * levels.size() + highest

  std::size_t size() const { return lowest.size(); }
  float low(std::size_t n) const { return levels[lowest[n]]; }
  float high(std::size_t n) const { return levels[highest[n]]; }
  std::size_t bytes() const {
    return lowest.size() + highest.size() + (levels.size() + counts.size()) * sizeof(float);
  }
};

/// Of a volume: blocks of 4 cells along each edge, of fewer where there are few voxels.
BlockRanges blockRanges(const Volume& volume);

/// Blocks of these real values, which are `count` and finite. Most values that many blocks share are levels,
/// and so are the least, the largest and 0 where it lies between them; up to 256 different ones all are.
BlockRanges blockRangesOf(int edge, glm::ivec3 count, const std::vector<float>& low,
                          const std::vector<float>& high);

}  // namespace volumen
