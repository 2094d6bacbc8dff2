#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace volumen {

/// Triangles of the surface in one cell (2 x 2 x 2 grid points). Corner x + 2 y + 4 z is the point (x, y, z).
/// Edges 0..3 run along x at (y, z) = (0, 0), (1, 0), (0, 1), (1, 1). Likewise edges 4..7 run along y at (x,
/// z), and edges 8..11 along z at (x, y).
struct CellTriangles {
  std::uint16_t crossed = 0;  ///< Bit n is set if the surface crosses edge n
  std::uint8_t count = 0;
  /// Each triangle connects crossings of three edges, anticlockwise seen from outside.
  std::array<std::array<std::uint8_t, 3>, 5> triangles{};
};

/// Returns the triangles for all 256 sets of inside corners (bit n: corner n). On each cell face, crossings
/// are joined so that diagonally opposite inside corners are separated; these segments form loops. Loops are
/// triangulated with diagonals between edges that share no cell face, which is always possible. So no
/// diagonal coincides with a face segment or a diagonal of the next cell, and every surface edge is in
/// exactly two triangles. Among all triangulations, the one closest to the 1/2 level of the trilinear field
/// is chosen.
std::span<const CellTriangles, 256> cellTriangles();

}  // namespace volumen
