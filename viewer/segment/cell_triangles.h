#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace volumen {

/// How the surface crosses one cell, of the 2 x 2 x 2 points of a grid. Corner x + 2 y + 4 z is the point
/// (x, y, z) of it. Edge 0..3 runs along x at (y, z) = (0, 0), (1, 0), (0, 1), (1, 1); 4..7 along y at
/// (x, z), 8..11 along z at (x, y).
struct CellTriangles {
  std::uint16_t crossed = 0;  ///< bit n: the surface crosses edge n
  std::uint8_t count = 0;
  /// Between the crossings of these edges; anticlockwise, seen from outside.
  std::array<std::array<std::uint8_t, 3>, 5> triangles{};
};

/// Of all 256 sets of corners inside (bit n: corner n). On the faces of a cell crossings are joined so that
/// corners inside are parted where they are opposite, and these segments form loops. Each is divided by
/// diagonals between edges that have no face of the cell in common, which is always possible: so no diagonal
/// is a segment on a face, or a diagonal of the next cell, and every edge of the surface is in exactly two
/// triangles. Of all ways that which lies nearest to where a trilinear field is 1/2.
std::span<const CellTriangles, 256> cellTriangles();

}  // namespace volumen
