#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <mutex>
#include <utility>

#include "viewer/segment/bit_rows.h"
#include "viewer/segment/farthest_points.h"
#include "viewer/segment/numbers.h"
#include "viewer/segment/surface_area.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

using glm::dmat3, glm::dvec3;

// Sums of powers of i, j, k over the voxels of a mask. Integers, so that the order does not matter.
struct Moments {
  std::int64_t voxels = 0;
  std::array<std::int64_t, 3> sum{};      // i, j, k
  std::array<std::int64_t, 6> product{};  // ii, jj, kk, ij, ik, jk
  VoxelBox box{glm::ivec3(INT32_MAX), glm::ivec3(INT32_MIN)};

  // Adds the voxels first..last of a row.
  void addRun(std::int64_t first, std::int64_t last, std::int64_t j, std::int64_t k) {
    const std::int64_t n = last - first + 1, i = (first + last) * n / 2;
    const auto squaresTo = [](std::int64_t m) { return m * (m + 1) * (2 * m + 1) / 6; };
    voxels += n;
    sum[0] += i, sum[1] += n * j, sum[2] += n * k;
    product[0] += squaresTo(last) - (first > 0 ? squaresTo(first - 1) : 0);
    product[1] += n * j * j, product[2] += n * k * k;
    product[3] += i * j, product[4] += i * k, product[5] += n * j * k;
    box.low = glm::min(box.low, glm::ivec3(first, j, k));
    box.high = glm::max(box.high, glm::ivec3(last, j, k));
  }
  void add(const Moments& other) {
    voxels += other.voxels;
    for (std::size_t n = 0; n < 3; ++n) sum[n] += other.sum[n];
    for (std::size_t n = 0; n < 6; ++n) product[n] += other.product[n];
    box.low = glm::min(box.low, other.box.low);
    box.high = glm::max(box.high, other.box.high);
  }
};

Moments momentsOf(const BitMask& mask) {
  Moments all;
  std::mutex mutex;
  parallelFor(mask.size().z, 0, [&](std::int64_t begin, std::int64_t end) {
    Moments here;
    for (int k = int(begin); k < int(end); ++k)
      for (int j = 0; j < mask.size().y; ++j)
        bits::forEachRun(mask.row(j, k), mask.size().x,
                         [&](int first, int behind) { here.addRun(first, behind - 1, j, k); });
    const std::lock_guard lock(mutex);
    all.add(here);
  });
  return all;
}

// Returns the covariance (dividing by n) of voxel positions, voxels^2.
dmat3 covariance(const Moments& m) {
  const double n = double(m.voxels);
  const dvec3 mean = dvec3(double(m.sum[0]), double(m.sum[1]), double(m.sum[2])) / n;
  const auto of = [&](std::size_t product, int a, int b) {
    return double(m.product[product]) / n - mean[a] * mean[b];
  };
  const double ij = of(3, 0, 1), ik = of(4, 0, 2), jk = of(5, 1, 2);
  return {of(0, 0, 0), ij, ik, ij, of(1, 1, 1), jk, ik, jk, of(2, 2, 2)};
}

// Returns the eigenvectors of a symmetric matrix as columns; its diagonal becomes the eigenvalues (Jacobi
// 1846).
dmat3 diagonalised(dmat3& a) {
  dmat3 vectors(1);
  for (int sweep = 0; sweep < 30; ++sweep)
    for (const auto& [p, q] : {std::pair(0, 1), {0, 2}, {1, 2}}) {
      if (a[p][q] == 0) continue;
      const double apart = a[q][q] - a[p][p], twice = 2 * a[p][q];
      const double angle = std::atan2(apart < 0 ? -twice : twice, std::abs(apart)) / 2;  // at most 45 degrees
      dmat3 turn(1);
      turn[p][p] = turn[q][q] = std::cos(angle);
      turn[q][p] = std::sin(angle), turn[p][q] = -std::sin(angle);
      a = glm::transpose(turn) * a * turn;
      a[p][q] = a[q][p] = 0;
      vectors = vectors * turn;
    }
  return vectors;
}

dvec3 withLargestPositive(dvec3 v) {
  int largest = 0;
  for (int a = 1; a < 3; ++a)
    if (std::abs(v[a]) > std::abs(v[largest])) largest = a;
  return v[largest] < 0 ? -v : v;
}

}  // namespace

Result<std::optional<SegmentForm>> voxelFormOf(const BitMask& mask, const CancelToken& cancel) {
  const VoxelGeometry& geometry = mask.geometry();
  const Moments moments = momentsOf(mask);
  if (!geometry.calibrated || moments.voxels == 0) return std::optional<SegmentForm>();
  SegmentForm form;
  form.ofVoxelsAlone = true;
  form.voxelMl = double(moments.voxels) * geometry.voxelVolume() / 1000;
  form.box = moments.box;
  form.centroid = geometry.patientFromVoxel(
      dvec3(double(moments.sum[0]), double(moments.sum[1]), double(moments.sum[2])) / double(moments.voxels));

  const dmat3& step = geometry.patientFromVoxelStep;
  dmat3 spread = step * covariance(moments) * glm::transpose(step);
  const dmat3 vectors = diagonalised(spread);
  std::array order{0, 1, 2};
  std::ranges::stable_sort(order, [&](int a, int b) { return spread[a][a] > spread[b][b]; });
  for (std::size_t n = 0; n < 3; ++n) {
    form.axes[n] = withLargestPositive(vectors[order[n]]);
    form.axisMm[int(n)] = 4 * std::sqrt(std::max(0.0, spread[order[n]][order[n]]));
  }
  form.inPlane = inPlaneDiameters(mask, cancel).value_or(InPlaneDiameters());
  if (cancel.cancelled()) return Error{"cancelled"};
  return std::optional(form);
}

Result<std::optional<SegmentForm>> formOf(const BitMask& mask, const CancelToken& cancel) {
  Result<std::optional<SegmentForm>> made = voxelFormOf(mask, cancel);
  if (!made || !*made) return made;
  SegmentForm& form = **made;
  form.ofVoxelsAlone = false;
  form.areaMm2 = boundaryArea(mask, cancel);
  const Result<Surface> surface = volumePreservingSurface(occupancyOf(mask, surfaceSigma, cancel), cancel);
  if (cancel.cancelled()) return Error{"cancelled"};
  if (!surface) return surface.error();
  form.surfaceMl = volumeOf(*surface) / 1000;
  const std::array<glm::vec3, 2> ends = farthestPoints(*surface);
  form.longestAt = {dvec3(ends[0]), dvec3(ends[1])};
  form.longestMm = glm::distance(form.longestAt[0], form.longestAt[1]);
  return made;
}

}  // namespace volumen
