#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>
#include <utility>

#include "viewer/segment/numbers.h"
#include "viewer/segment/surface_distance.h"

namespace volumen {

namespace {

// Returns the distance that 95 % of the area do not exceed.
double distanceOf95Percent(const SurfaceDistances& all) {
  std::vector<std::uint32_t> order(all.ofTriangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(all.ofTriangles[a], a) < std::pair(all.ofTriangles[b], b);
  });
  const double part = 0.95 * std::accumulate(all.areas.begin(), all.areas.end(), 0.0);
  double area = 0;
  for (const std::uint32_t t : order)
    if ((area += all.areas[t]) >= part) return all.ofTriangles[t];
  return all.ofTriangles[order.back()];
}

// Returns the smallest distance that float points can represent: the precision of the largest coordinate.
double leastDistance(std::initializer_list<const Surface*> surfaces) {
  float largest = 0;
  for (const Surface* surface : surfaces)
    for (const glm::vec3& p : surface->points)
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return double(largest) * double(std::numeric_limits<float>::epsilon());
}

// Returns distances with values below `least` set to 0.
SurfaceDistances distancesFrom(const TriangleTree& of, const TriangleTree& to, double least,
                               const CancelToken& cancel) {
  SurfaceDistances all = distances(of, to, cancel);
  for (double& d : all.ofTriangles) d = d < least ? 0 : d;
  all.largest = all.largest < least ? 0 : all.largest;
  return all;
}

Result<SegmentLikeness::Distances> distancesBetween(const BitMask& a, const BitMask& b,
                                                    const CancelToken& cancel) {
  const Result<Surface> ofA = volumePreservingSurface(occupancyOf(a, surfaceSigma, cancel), cancel);
  const Result<Surface> ofB = volumePreservingSurface(occupancyOf(b, surfaceSigma, cancel), cancel);
  if (cancel.cancelled()) return Error{"cancelled"};
  if (!ofA || !ofB) return ofA ? ofB.error() : ofA.error();
  const TriangleTree treeA(*ofA), treeB(*ofB);
  const double least = leastDistance({&*ofA, &*ofB});
  SegmentLikeness::Distances found;
  double sum = 0, area = 0;
  for (const auto& [of, to] : {std::pair(&treeA, &treeB), {&treeB, &treeA}}) {
    const SurfaceDistances all = distancesFrom(*of, *to, least, cancel);
    if (cancel.cancelled()) return Error{"cancelled"};
    found.largest = std::max(found.largest, all.largest);
    found.p95 = std::max(found.p95, distanceOf95Percent(all));
    sum += std::inner_product(all.areas.begin(), all.areas.end(), all.ofTriangles.begin(), 0.0);
    area = std::accumulate(all.areas.begin(), all.areas.end(), area);
  }
  found.mean = sum / area;
  return found;
}

}  // namespace

Result<SegmentLikeness> likeness(const BitMask& a, const BitMask& b, const CancelToken& cancel) try {
  assert(a.geometry() == b.geometry());
  const std::int64_t inA = a.count(), inB = b.count();
  SegmentLikeness alike;
  if (inA + inB > 0) alike.dice = 2 * double(intersected(a, b).count()) / double(inA + inB);
  if (!a.geometry().calibrated) return alike;
  alike.differenceMl = double(inA - inB) * a.geometry().voxelVolume() / 1000;
  if (inA == 0 || inB == 0) return alike;
  const Result<SegmentLikeness::Distances> found = distancesBetween(a, b, cancel);
  if (!found) return found.error();
  alike.distances = *found;
  return alike;
} catch (const std::bad_alloc&) {
  return Error{"There is not enough memory to compare the segments."};
}

}  // namespace volumen
