#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/volume/buffer.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Gradients16 of parts of a volume: cubes of 8 x 8 x 8 cells ("bricks"), each with all voxels that its cells
/// touch, so that a cell lies in one brick. Bricks that are left out share one that shows nothing.
struct GradientBricks16 {
  static constexpr int shift = 3, cells = 1 << shift;  ///< along an edge
  static constexpr int row = cells + 1;                ///< voxels from a row along i to the next
  static constexpr int slice = row * row, all = slice * row;

  glm::ivec3 count{0};              ///< bricks along each axis
  std::vector<std::int32_t> first;  ///< of each brick, i fastest: its first voxel in `xyzd`
  Buffer<std::int16_t> xyzd;        ///< as Gradients16
  double scale = 1;

  static glm::ivec3 countOf(glm::ivec3 size) { return (size + (cells - 1)) / cells; }
  /// What so many bricks take, beside the one that shows nothing.
  static std::uint64_t bytesOf(std::int64_t bricks, glm::ivec3 count);
  std::size_t bytes() const { return xyzd.bytes() + first.size() * sizeof(first[0]); }
};

/// The numbers of sobel16(), on all cores. `kept`: one entry a brick. The others show a voxel of the first
/// brick that is left out, which there must be, without a gradient: its corner.
GradientBricks16 sobelBricks16(const Volume& volume, const std::vector<std::uint8_t>& kept);

}  // namespace volumen
