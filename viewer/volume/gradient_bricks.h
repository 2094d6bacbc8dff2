#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/volume/buffer.h"
#include "viewer/volume/volume.h"

namespace volumen {

/// Gradients16 of parts of a volume: bricks of 8 x 8 x 8 cells. A brick stores all 9 x 9 x 9 voxels of its
/// cells, so that each cell lies in one brick. Omitted bricks share one brick without gradients.
struct GradientBricks16 {
  static constexpr int shift = 3, cells = 1 << shift;  ///< Cells along an edge
  static constexpr int row = cells + 1;                ///< Voxels from one row along i to the next
  static constexpr int slice = row * row, all = slice * row;

  glm::ivec3 count{0};              ///< Bricks along each axis
  std::vector<std::int32_t> first;  ///< First voxel of each brick in `xyzd`; bricks with i fastest
  Buffer<std::int16_t> xyzd;        ///< Layout of Gradients16::xyzd
  double scale = 1;

  static glm::ivec3 countOf(glm::ivec3 size) { return (size + (cells - 1)) / cells; }
  /// Returns the bytes of `bricks` kept bricks and the shared omitted one.
  static std::uint64_t bytesOf(std::int64_t bricks, glm::ivec3 count);
  std::size_t bytes() const { return xyzd.bytes() + first.size() * sizeof(first[0]); }
};

/// Returns the gradients of sobel16() for the bricks with a nonzero entry in `kept`, computed on all cores.
/// At least one brick must be omitted. All voxels of the shared brick have the density of the corner of the
/// first omitted brick, and no gradient.
GradientBricks16 sobelBricks16(const Volume& volume, const std::vector<std::uint8_t>& kept);

}  // namespace volumen
