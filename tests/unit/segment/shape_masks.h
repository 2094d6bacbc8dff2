#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "tests/fixtures/chance.h"
#include "tests/fixtures/grids.h"
#include "viewer/segment/bit_mask.h"
#include "viewer/segment/surface.h"

namespace volumen::tests {

/// Returns whether a point in patient space is inside a shape.
using Shape3 = std::function<bool(glm::dvec3)>;

inline Shape3 ellipsoid(glm::dvec3 halfAxes, glm::dvec3 centre = glm::dvec3(0)) {
  return [=](glm::dvec3 p) { return glm::length((p - centre) / halfAxes) <= 1; };
}
inline Shape3 ball(double radius, glm::dvec3 centre = glm::dvec3(0)) {
  return ellipsoid(glm::dvec3(radius), centre);
}
inline Shape3 cylinder(double radius, double height, glm::dvec3 along) {
  return [=, axis = glm::normalize(along)](glm::dvec3 p) {
    const double t = glm::dot(p, axis);
    return std::abs(t) <= height / 2 && glm::length(p - t * axis) <= radius;
  };
}

/// Returns a grid around the origin of patient space that holds a ball of `reach` mm. The origin lies off the
/// voxel centres.
inline VoxelGeometry gridAbout(const glm::dmat3& step, double reach) {
  VoxelGeometry grid;
  grid.patientFromVoxelStep = step;
  const glm::dmat3 rows = glm::transpose(glm::inverse(step));
  for (int a = 0; a < 3; ++a) grid.size[a] = 3 + 2 * int(std::ceil(reach * glm::length(rows[a])));
  grid.origin = -(step * (glm::dvec3(grid.size - 1) / 2.0 + glm::dvec3(0.13, -0.21, 0.34)));
  return grid;
}

/// Returns the voxels whose centres are inside.
inline BitMask maskOfShape(const VoxelGeometry& grid, const Shape3& isIn) {
  BitMask mask(grid);
  for (int k = 0; k < grid.size.z; ++k)
    for (int j = 0; j < grid.size.y; ++j)
      for (int i = 0; i < grid.size.x; ++i)
        if (isIn(grid.patientFromVoxel(glm::dvec3(i, j, k)))) mask.set({i, j, k});
  return mask;
}

/// Returns the digital phantom of the Image Biomarker Standardisation Initiative: 5 x 4 x 4 voxels of 2 mm,
/// six of them outside its region.
inline BitMask ibsiPhantom() {
  BitMask mask({.size = {5, 4, 4}, .patientFromVoxelStep = glm::dmat3(2)});
  const std::set<std::array<int, 3>> out{{0, 2, 1}, {3, 0, 2}, {4, 0, 2}, {2, 2, 2}, {3, 0, 3}, {4, 0, 3}};
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 5; ++i) mask.set({i, j, k}, !out.contains({i, j, k}));
  return mask;
}

/// Returns random values at the points of a small box, and 0 on its border. Points inside have any density.
/// Values are 1 and 0, or random on either side of 1/2.
inline OccupancyField anyField(std::uint64_t seed) {
  Chance chance(seed);
  OccupancyField field;
  field.geometry.size = {1 + chance.below(9), 1 + chance.below(9), 1 + chance.below(9)};
  if (chance.oneIn(20)) field.geometry.size.x = 60 + chance.below(10);  // rows longer than a word
  field.geometry.patientFromVoxelStep = grids[chance.below(int(std::size(grids)))].patientFromVoxelStep;
  field.geometry.origin = 300.0 * chance.vector();
  field.box = {glm::ivec3(-1), field.geometry.size};
  const double density = chance.share();
  const bool binary = chance.oneIn(3);
  const glm::ivec3 size = field.size();
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const bool onBorder =
            i == 0 || j == 0 || k == 0 || i + 1 == size.x || j + 1 == size.y || k + 1 == size.z;
        const bool isIn = !onBorder && chance.share() < density;
        const double away = binary ? 0.5 : chance.between(0.02, 0.5);
        field.values.push_back(onBorder ? 0 : float(isIn ? 0.5 + away : 0.5 - away));
      }
  return field;
}

/// Returns a field that crosses 1/2 nearly linearly where the distance `inwards` from a shape crosses 0.
inline OccupancyField fieldOf(const VoxelGeometry& grid, const std::function<double(glm::dvec3)>& inwards) {
  OccupancyField field{grid, {glm::ivec3(-1), grid.size}, {}};
  const double steep = 0.4 / std::max({grid.spacing().x, grid.spacing().y, grid.spacing().z});
  for (int k = -1; k <= grid.size.z; ++k)
    for (int j = -1; j <= grid.size.y; ++j)
      for (int i = -1; i <= grid.size.x; ++i)
        field.values.push_back(
            float(std::clamp(0.5 + steep * inwards(grid.patientFromVoxel(glm::dvec3(i, j, k))), 0.0, 1.0)));
  return field;
}

/// Returns the surface of such a field of a ball.
inline Surface ballSurface(double radius, const glm::dmat3& step, glm::dvec3 centre = glm::dvec3(0)) {
  return *surfaceOf(fieldOf(gridAbout(step, radius + glm::length(centre) + 1),
                            [&](glm::dvec3 p) { return radius - glm::distance(p, centre); }));
}

/// Returns why a surface is not closed; empty if it is. Every edge is in two triangles, once in each
/// direction. The triangles about each point form one ring. All points are used, and no two coincide.
/// Therefore the Euler characteristic of each component is even.
inline std::string notClosed(const Surface& surface) {
  // corner c opposite to the edge a b
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> opposite;
  std::map<std::uint32_t, int> degrees;
  for (const auto& t : surface.triangles)
    for (std::size_t n = 0; n < 3; ++n) {
      if (!opposite.emplace(std::pair(t[n], t[(n + 1) % 3]), t[(n + 2) % 3]).second)
        return "an edge is twice in one direction";
      ++degrees[t[n]];
    }
  for (const auto& [edge, corner] : opposite)
    if (!opposite.contains({edge.second, edge.first})) return "an edge is in one triangle";
  if (degrees.size() != surface.points.size()) return "a point is in no triangle";
  for (const auto& t : surface.triangles)
    for (std::size_t n = 0; n < 3; ++n) {
      int ring = 0;
      std::uint32_t at = t[(n + 1) % 3];
      do {
        at = opposite.at({t[n], at});
        ++ring;
      } while (at != t[(n + 1) % 3]);
      if (ring != degrees[t[n]]) return "the triangles about a point form two rings";
    }
  std::set<std::array<float, 3>> places;
  for (const glm::vec3& p : surface.points) places.insert({p.x, p.y, p.z});
  if (places.size() != surface.points.size()) return "two points are at one place";
  const auto euler = std::int64_t(surface.points.size()) - std::int64_t(opposite.size() / 2) +
                     std::int64_t(surface.triangles.size());
  return euler % 2 ? "Euler's number is odd" : "";
}

}  // namespace volumen::tests
