#pragma once

#include <array>
#include <glm/common.hpp>

#include "viewer/reference/polynomial.h"
#include "viewer/volume/volume.h"

namespace volumen::reference {

/// Data at the eight corners of the cell between voxels c and c + (1, 1, 1), with index i + 2 j + 4 k. Voxel
/// indices are clamped to the volume (picture.md 2), so that cells -1 and n - 1 are the half-voxel border.
template <class T>
using Corners = std::array<T, 8>;

Corners<double> cornerValues(const Volume& volume, glm::ivec3 cell);
/// Returns Sobel gradients (picture.md 3), in value per voxel.
Corners<glm::dvec3> cornerGradients(const Volume& volume, glm::ivec3 cell);

/// Returns trilinear interpolation at start + s move (position within the cell, voxels) as a polynomial of s.
/// Interpolates as a + f (b - a): a constant cell gives exactly its constant and no higher coefficient.
template <class T>
Polynomial<T, 3> interpolateAlong(const Corners<T>& corners, glm::dvec3 start, glm::dvec3 move) {
  std::array<Polynomial<T, 3>, 8> p;
  for (int n = 0; n < 8; ++n) p[n].c[0] = corners[n];
  for (int axis = 0, count = 4; axis < 3; ++axis, count /= 2) {
    for (int n = 0; n < count; ++n) {
      const auto a = p[2 * n], b = p[2 * n + 1];
      for (int power = 0; power <= 3; ++power) {
        p[n].c[power] = a.c[power] + start[axis] * (b.c[power] - a.c[power]);
        if (power > 0) p[n].c[power] += move[axis] * (b.c[power - 1] - a.c[power - 1]);
      }
    }
  }
  return p[0];
}

/// Returns trilinear interpolation at a position in the cell (clamped to it). Constant cells stay exactly
/// constant (picture.md 2), and a corner of 1e30 causes no rounding where its weight is 0.
inline double interpolateAt(const Corners<double>& c, glm::dvec3 place) {
  const glm::dvec3 f = glm::clamp(place, 0.0, 1.0);
  const auto between = [](double a, double b, double share) {
    return share < 0.5 ? a + share * (b - a) : b - (1 - share) * (b - a);
  };
  const auto row = [&](int n) { return between(c[n], c[n + 1], f.x); };
  return between(between(row(0), row(2), f.y), between(row(4), row(6), f.y), f.z);
}

}  // namespace volumen::reference
