#include "viewer/segment/cell_triangles.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

namespace volumen {

namespace {

constexpr int cellEdges = 12;
using EdgeLoop = std::vector<std::uint8_t>;

// The axes across an edge along `axis`, in the order in which edges are counted.
constexpr std::pair<int, int> axesAcross(int axis) { return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2}; }

// Of two corners that differ along one axis.
int edgeBetween(int a, int b) {
  const int low = std::min(a, b), axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2;
  const auto [first, second] = axesAcross(axis);
  return 4 * axis + (low >> first & 1) + 2 * (low >> second & 1);
}

bool shareFace(int a, int b) {
  const auto sides = [](int edge) {
    const auto [first, second] = axesAcross(edge / 4);
    return std::array{2 * first + (edge & 1), 2 * second + (edge >> 1 & 1)};
  };
  const auto of = sides(a);
  return std::ranges::any_of(sides(b), [&](int side) { return side == of[0] || side == of[1]; });
}

// The corners of a face, anticlockwise seen from outside the cell.
std::array<int, 4> cornersOfFace(int axis, bool high) {
  const int first = 1 << (axis + 1) % 3, second = 1 << (axis + 2) % 3, base = high ? 1 << axis : 0;
  if (high) return {base, base + first, base + first + second, base + second};
  return {base, base + second, base + first + second, base + first};
}

// Each crossed edge to the next of its loop: going round a face, from where corners inside begin to where
// they end.
std::array<int, cellEdges> nextCrossings(int inside) {
  std::array<int, cellEdges> next;
  next.fill(-1);
  const auto isIn = [&](int corner) { return (inside >> corner & 1) != 0; };
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> corners = cornersOfFace(face / 2, face % 2 == 1);
    for (std::size_t n = 0; n < 4; ++n) {
      if (isIn(corners[n]) || !isIn(corners[(n + 1) % 4])) continue;
      std::size_t last = n + 1;
      while (isIn(corners[(last + 1) % 4])) ++last;
      next[std::size_t(edgeBetween(corners[n], corners[(n + 1) % 4]))] =
          edgeBetween(corners[last % 4], corners[(last + 1) % 4]);
    }
  }
  return next;
}

std::vector<EdgeLoop> loopsOf(std::array<int, cellEdges> next) {
  std::vector<EdgeLoop> loops;
  for (int first = 0; first < cellEdges; ++first) {
    EdgeLoop loop;
    for (int edge = first; next[std::size_t(edge)] >= 0;) {
      loop.push_back(std::uint8_t(edge));
      edge = std::exchange(next[std::size_t(edge)], -1);
    }
    if (!loop.empty()) loops.push_back(std::move(loop));
  }
  return loops;
}

// Divides what lies between the loop's places first..last and the line that joins them. False: it cannot be.
bool divide(const EdgeLoop& loop, std::size_t first, std::size_t last, CellTriangles& cell) {
  if (last - first < 2) return true;
  const auto joined = [&](std::size_t a, std::size_t b) {
    return b - a == 1 || b - a == loop.size() - 1 || !shareFace(loop[a], loop[b]);
  };
  for (std::size_t n = first + 1; n < last; ++n) {
    if (!joined(first, n) || !joined(n, last)) continue;
    const std::uint8_t before = cell.count;
    cell.triangles[cell.count++] = {loop[first], loop[n], loop[last]};
    if (divide(loop, first, n, cell) && divide(loop, n, last, cell)) return true;
    cell.count = before;
  }
  return false;
}

CellTriangles trianglesOf(int inside) {
  CellTriangles cell;
  for (const EdgeLoop& loop : loopsOf(nextCrossings(inside))) {
    for (const std::uint8_t edge : loop) cell.crossed |= std::uint16_t(1 << edge);
    [[maybe_unused]] const bool divided = divide(loop, 0, loop.size() - 1, cell);
    assert(divided);
  }
  return cell;
}

}  // namespace

std::span<const CellTriangles, 256> cellTriangles() {
  static const std::array<CellTriangles, 256> all = [] {
    std::array<CellTriangles, 256> cells;
    for (int inside = 0; inside < 256; ++inside) cells[std::size_t(inside)] = trianglesOf(inside);
    return cells;
  }();
  return all;
}

}  // namespace volumen
