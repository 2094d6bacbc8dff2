#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// Smallest and largest value of each block of edge^3 cells. Block (a, b, c) bounds every trilinear value
/// v(x) with edge a <= x < edge (a + 1) (likewise y, z). It thus spans the voxels edge a .. edge a + edge,
/// clamped to the grid. Bounds are stored as one byte each: the next outward one of a few levels. They take 3
/// % of the memory of 16-bit densities.
struct BlockRanges {
  static constexpr int mostLevels = 256;
  int edge = 4;  ///< Edge of a block in cells; a power of two
  glm::ivec3 count{0};
  std::vector<float> levels;                  ///< Real values, ascending
  std::vector<std::uint8_t> lowest, highest;  ///< Levels that bound each block's values; i fastest
  /// Number of blocks per pair of levels: entry lowest * levels.size() + highest.
  std::vector<std::uint32_t> counts;

  std::size_t size() const { return lowest.size(); }
  float low(std::size_t n) const { return levels[lowest[n]]; }
  float high(std::size_t n) const { return levels[highest[n]]; }
  std::size_t bytes() const {
    return lowest.size() + highest.size() + (levels.size() + counts.size()) * sizeof(float);
  }
};

/// Returns the ranges of a volume: blocks of 4 cells per edge, fewer for small volumes.
BlockRanges blockRanges(const Volume& volume);

/// Returns the ranges of `count` blocks with these finite real values. Levels are mostly values that many
/// blocks share, plus the smallest, the largest, and 0 if it lies between. Up to 256 distinct values are all
/// levels.
BlockRanges blockRangesOf(int edge, glm::ivec3 count, const std::vector<float>& low,
                          const std::vector<float>& high);

}  // namespace volumen
