#include "viewer/segment/surface_area.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <numeric>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

using glm::dvec3;

constexpr int mostSteps = 63;  // along an axis: a row is moved within two words

// A step of the grid, and what it is in patient space.
struct GridStep {
  glm::ivec3 step;
  dvec3 unit;
  double length;  // mm
};

// How long directions may be, mm: as long as that angles between slices and the columns that cross them are
// filled, and no longer, for long steps miss edges.
double reachOf(const VoxelGeometry& geometry) {
  const glm::dmat3& step = geometry.patientFromVoxelStep;
  const double longest = std::max({glm::length(step[0]), glm::length(step[1]), glm::length(step[2])});
  return std::max(1.3 * longest, 2.3 * std::cbrt(geometry.voxelVolume()));
}

// One of each pair +-d of the steps to neighbours and of others within reach, none a multiple of another one,
// the shortest first.
std::vector<GridStep> stepsWithinReach(const VoxelGeometry& geometry) {
  const double reach = reachOf(geometry);
  const glm::dmat3 rows = glm::transpose(glm::inverse(geometry.patientFromVoxelStep));
  glm::ivec3 most;
  for (int a = 0; a < 3; ++a)
    most[a] = int(std::clamp(std::floor(reach * glm::length(rows[a])), 1.0, double(mostSteps)));
  std::vector<GridStep> all;
  for (int k = 0; k <= most.z; ++k)
    for (int j = k ? -most.y : 0; j <= most.y; ++j)
      for (int i = k || j ? -most.x : 1; i <= most.x; ++i) {
        if (std::gcd(std::gcd(i, j), k) != 1) continue;
        const dvec3 d = geometry.patientFromVoxelStep * dvec3(i, j, k);
        const bool isNeighbour = std::max({std::abs(i), std::abs(j), k}) == 1;
        if (const double length = glm::length(d); isNeighbour || length <= reach)
          all.push_back({{i, j, k}, d / length, length});
      }
  std::ranges::stable_sort(all, [](const GridStep& a, const GridStep& b) {
    return a.length < b.length * (1 - 1e-9);  // what is as long stays in order
  });
  return all;
}

// Without those that run nearly as a shorter one does.
std::vector<GridStep> apart(const std::vector<GridStep>& all) {
  const double near = std::cos(8 * std::numbers::pi / 180);
  std::vector<GridStep> kept;
  for (const GridStep& step : all)
    if (std::ranges::none_of(kept,
                             [&](const GridStep& k) { return std::abs(glm::dot(k.unit, step.unit)) > near; }))
      kept.push_back(step);
  return kept;
}

// Points of half the sphere, spread evenly (a spiral).
std::vector<dvec3> pointsOfSphere() {
  constexpr int count = 600;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<dvec3> points;
  for (int n = 0; n < count; ++n) {
    const double z = (n + 0.5) / count, turn = n * golden, r = std::sqrt(1 - z * z);
    points.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return points;
}

// The weights, none below 0, with which planes of every direction n come out nearest to their area: sum
// w |u n| = 1/2 in the least squares (multiplicative updates: Daube-Witherspoon and Muehllehner 1986).
std::vector<double> weightsOf(const std::vector<GridStep>& steps) {
  const std::vector<dvec3> points = pointsOfSphere();
  const std::size_t count = steps.size();
  std::vector<double> wanted(count), products(count * count);
  std::vector<double> cosines(count * points.size());
  for (std::size_t d = 0; d < count; ++d)
    for (std::size_t p = 0; p < points.size(); ++p) {
      cosines[d * points.size() + p] = std::abs(glm::dot(steps[d].unit, points[p]));
      wanted[d] += cosines[d * points.size() + p] / 2;
    }
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      const auto ofA = cosines.begin() + std::ptrdiff_t(a * points.size()),
                 ofB = cosines.begin() + std::ptrdiff_t(b * points.size());
      products[a * count + b] = products[b * count + a] =
          std::inner_product(ofA, ofA + std::ptrdiff_t(points.size()), ofB, 0.0);
    }
  std::vector<double> weights(count, 1 / double(count)), next(count);
  for (int round = 0; round < 1000; ++round) {
    for (std::size_t a = 0; a < count; ++a)
      next[a] = weights[a] * wanted[a] /
                std::inner_product(weights.begin(), weights.end(),
                                   products.begin() + std::ptrdiff_t(a * count), 0.0);
    weights.swap(next);
  }
  return weights;
}

// How many voxels of two rows are in both, `from` moved by `along` bits down (0 to 63).
std::int64_t overlap(std::span<const std::uint64_t> row, std::span<const std::uint64_t> from, int along) {
  std::int64_t count = 0;
  for (std::size_t w = 0; w < row.size(); ++w) {
    std::uint64_t there = from[w];
    if (along) there = there >> along | (w + 1 < from.size() ? from[w + 1] << (64 - along) : 0);
    count += std::popcount(row[w] & there);
  }
  return count;
}

// For each direction, how many voxels of the mask have their neighbour there in it.
std::vector<std::int64_t> neighbourCounts(const BitMask& mask, const std::vector<CrossingDirection>& all) {
  const glm::ivec3 size = mask.size();
  std::vector<std::atomic<std::int64_t>> counts(all.size());
  parallelFor(size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (int k = int(begin); k < int(end); ++k)
      for (int j = 0; j < size.y; ++j) {
        const auto row = mask.row(j, k);
        if (std::ranges::all_of(row, [](std::uint64_t word) { return word == 0; })) continue;
        for (std::size_t d = 0; d < all.size(); ++d) {
          const glm::ivec3 step = all[d].step;
          const int y = j + step.y, z = k + step.z;
          if (y < 0 || y >= size.y || z >= size.z) continue;
          const auto there = mask.row(y, z);
          counts[d] += step.x < 0 ? overlap(there, row, -step.x) : overlap(row, there, step.x);
        }
      }
  });
  return {counts.begin(), counts.end()};
}

}  // namespace

std::vector<CrossingDirection> crossingDirections(const VoxelGeometry& geometry) {
  const std::vector<GridStep> steps = apart(stepsWithinReach(geometry));
  const std::vector<double> weights = weightsOf(steps);
  std::vector<CrossingDirection> all;
  for (std::size_t d = 0; d < steps.size(); ++d)
    all.push_back({steps[d].step, weights[d], 2 * weights[d] * geometry.voxelVolume() / steps[d].length});
  return all;
}

double boundaryArea(const BitMask& mask) {
  const std::int64_t voxels = mask.count();
  if (voxels == 0) return 0;
  const std::vector<CrossingDirection> directions = crossingDirections(mask.geometry());
  const std::vector<std::int64_t> neighbours = neighbourCounts(mask, directions);
  double area = 0;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    // Every line enters and leaves where a voxel has no neighbour behind or before it.
    const double crossings = 2 * double(voxels - neighbours[d]);
    area += directions[d].areaOfCrossing * crossings;
  }
  return area;
}

}  // namespace volumen
