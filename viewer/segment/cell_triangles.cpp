#include "viewer/segment/cell_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace volumen {

namespace {

constexpr int cellEdges = 12;
using EdgeLoop = std::vector<std::uint8_t>;

// Returns the two axes across an edge along `axis`, in the order of edge numbers.
constexpr std::pair<int, int> axesAcross(int axis) { return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2}; }

// Returns the edge between two corners that differ along one axis.
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

// Returns the corners of a face, anticlockwise seen from outside the cell.
std::array<int, 4> cornersOfFace(int axis, bool high) {
  const int first = 1 << (axis + 1) % 3, second = 1 << (axis + 2) % 3, base = high ? 1 << axis : 0;
  if (high) return {base, base + first, base + first + second, base + second};
  return {base, base + second, base + first + second, base + first};
}

// Returns for each crossed edge the next one of its loop. Around a face, the loop leads from where inside
// corners begin to where they end.
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

using Triangles = std::vector<std::array<std::uint8_t, 3>>;

// Returns all triangulations of the polygon loop[first..last].
std::vector<Triangles> divisionsOf(const EdgeLoop& loop, std::size_t first, std::size_t last) {
  if (last - first < 2) return {{}};
  const auto joined = [&](std::size_t a, std::size_t b) {
    return b - a == 1 || b - a == loop.size() - 1 || !shareFace(loop[a], loop[b]);
  };
  std::vector<Triangles> all;
  for (std::size_t n = first + 1; n < last; ++n) {
    if (!joined(first, n) || !joined(n, last)) continue;
    for (const Triangles& before : divisionsOf(loop, first, n))
      for (const Triangles& behind : divisionsOf(loop, n, last)) {
        all.push_back({{loop[first], loop[n], loop[last]}});
        all.back().insert(all.back().end(), before.begin(), before.end());
        all.back().insert(all.back().end(), behind.begin(), behind.end());
      }
  }
  return all;
}

// Returns the midpoint of an edge in cell coordinates.
glm::dvec3 middleOfEdge(int edge) {
  const int axis = edge / 4;
  const auto [first, second] = axesAcross(axis);
  glm::dvec3 x(0);
  x[axis] = 0.5, x[first] = edge & 1, x[second] = edge >> 1 & 1;
  return x;
}

// Returns the trilinear field of a cell that is 1 at inside corners and 0 at the others.
double fieldAt(int inside, glm::dvec3 x) {
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = inside >> corner & 1;
    for (int a = 0; a < 3; ++a) weight *= corner >> a & 1 ? x[a] : 1 - x[a];
    sum += weight;
  }
  return sum;
}

// Returns the triangulation whose triangle centroids have field values closest to 1/2. Ties go to the one
// whose deviations to both sides balance best.
Triangles nearestDivision(const std::vector<Triangles>& divisions, int inside) {
  return std::ranges::min(divisions, {}, [&](const Triangles& triangles) {
    double off = 0, aside = 0;
    for (const auto& [a, b, c] : triangles) {
      const double value = fieldAt(inside, (middleOfEdge(a) + middleOfEdge(b) + middleOfEdge(c)) / 3.0) - 0.5;
      off += std::abs(value), aside += value;
    }
    // Rounded, so that equal ones compare equal.
    return std::pair(std::round(off * 1e6), std::round(std::abs(aside) * 1e6));
  });
}

CellTriangles trianglesOf(int inside) {
  CellTriangles cell;
  for (const EdgeLoop& loop : loopsOf(nextCrossings(inside))) {
    for (const std::uint8_t edge : loop) cell.crossed |= std::uint16_t(1 << edge);
    for (const auto& triangle : nearestDivision(divisionsOf(loop, 0, loop.size() - 1), inside))
      cell.triangles[cell.count++] = triangle;
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
