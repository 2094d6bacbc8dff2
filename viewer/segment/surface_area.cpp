#include "viewer/segment/surface_area.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

using glm::dvec2, glm::dvec3;

// One of each pair +-d of the steps from a voxel to its 26 neighbours. Along i none or one: a row is moved by
// at most one bit, and never down.
constexpr int directionCount = 13;
constexpr std::array<glm::ivec3, directionCount> directions{{{1, 0, 0},
                                                             {0, 1, 0},
                                                             {0, 0, 1},
                                                             {1, 1, 0},
                                                             {1, -1, 0},
                                                             {1, 0, 1},
                                                             {1, 0, -1},
                                                             {0, 1, 1},
                                                             {0, 1, -1},
                                                             {1, 1, 1},
                                                             {1, 1, -1},
                                                             {1, -1, 1},
                                                             {1, -1, -1}}};

// What of a convex polygon lies where dot(x, normal) >= -offset (Sutherland and Hodgman 1974).
std::vector<dvec2> clipped(const std::vector<dvec2>& polygon, dvec2 normal, double offset) {
  std::vector<dvec2> left;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const dvec2 a = polygon[n], b = polygon[(n + 1) % polygon.size()];
    const double da = glm::dot(a, normal) + offset, db = glm::dot(b, normal) + offset;
    if (da >= 0) left.push_back(a);
    if ((da < 0) != (db < 0)) left.push_back(a + (b - a) * (da / (da - db)));
  }
  return left;
}

// The solid angle of the triangle a, b, c seen from the origin (Van Oosterom and Strackee 1983).
double solidAngle(dvec3 a, dvec3 b, dvec3 c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double across = glm::dot(a, glm::cross(b, c));
  const double along = la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
  return 2 * std::atan2(std::abs(across), along);
}

// The part of the sphere that is nearer to `axis` or -axis than to any other of the unit vectors and their
// opposites: seen on the plane that touches the sphere at `axis`, a convex polygon.
double shareOfSphere(dvec3 axis, const std::array<dvec3, directionCount>& all) {
  const dvec3 aside = std::abs(axis.x) < 0.7 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  const dvec3 u = glm::normalize(glm::cross(axis, aside)), v = glm::cross(axis, u);
  constexpr double wide = 1e6;
  std::vector<dvec2> polygon{{-wide, -wide}, {wide, -wide}, {wide, wide}, {-wide, wide}};
  for (const dvec3& other : all)
    for (const double sign : {1.0, -1.0}) {
      const dvec3 d = axis - sign * other;
      if (glm::dot(d, d) > 0) polygon = clipped(polygon, {glm::dot(d, u), glm::dot(d, v)}, glm::dot(d, axis));
    }
  double angle = 0;
  const auto onPlane = [&](dvec2 p) { return axis + p.x * u + p.y * v; };
  for (std::size_t n = 1; n + 1 < polygon.size(); ++n)
    angle += solidAngle(onPlane(polygon[0]), onPlane(polygon[n]), onPlane(polygon[n + 1]));
  return angle / (2 * std::numbers::pi);
}

// How many voxels of two rows are in both, `from` moved by `along` bits down.
std::int64_t overlap(std::span<const std::uint64_t> row, std::span<const std::uint64_t> from, int along) {
  std::int64_t count = 0;
  for (std::size_t w = 0; w < row.size(); ++w) {
    std::uint64_t there = from[w];
    if (along) there = there >> 1 | (w + 1 < from.size() ? from[w + 1] << 63 : 0);
    count += std::popcount(row[w] & there);
  }
  return count;
}

// For each direction, how many voxels of the mask have their neighbour there in it.
std::array<std::int64_t, directionCount> neighbourCounts(const BitMask& mask) {
  const glm::ivec3 size = mask.size();
  std::array<std::atomic<std::int64_t>, directionCount> counts{};
  parallelFor(size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (int k = int(begin); k < int(end); ++k)
      for (int j = 0; j < size.y; ++j) {
        const auto row = mask.row(j, k);
        if (std::ranges::all_of(row, [](std::uint64_t word) { return word == 0; })) continue;
        for (std::size_t d = 0; d < directions.size(); ++d) {
          const int y = j + directions[d].y, z = k + directions[d].z;
          if (y >= 0 && y < size.y && z >= 0 && z < size.z)
            counts[d] += overlap(row, mask.row(y, z), directions[d].x);
        }
      }
  });
  std::array<std::int64_t, directionCount> all;
  for (std::size_t d = 0; d < all.size(); ++d) all[d] = counts[d];
  return all;
}

}  // namespace

double boundaryArea(const BitMask& mask) {
  std::array<dvec3, directionCount> units;
  std::array<double, directionCount> lengths;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    const dvec3 step = mask.geometry().patientFromVoxelStep * dvec3(directions[d]);
    lengths[d] = glm::length(step);
    units[d] = step / lengths[d];
  }
  const std::int64_t voxels = mask.count();
  const auto neighbours = neighbourCounts(mask);
  double area = 0;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    // Every line enters and leaves where a voxel has no neighbour behind or before it.
    const double crossings = 2 * double(voxels - neighbours[d]);
    area += 2 * shareOfSphere(units[d], units) * crossings * mask.geometry().voxelVolume() / lengths[d];
  }
  return area;
}

}  // namespace volumen
