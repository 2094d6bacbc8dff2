#include "viewer/segment/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <mutex>
#include <numeric>
#include <utility>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

using glm::dvec3;

double squared(dvec3 v) { return glm::dot(v, v); }

// Finds the feature (corner, edge, face) nearest to p: Christer Ericson, Real-Time Collision Detection,
// 5.1.5.
double squaredDistance(dvec3 p, const TriangleTree::Triangle& triangle) {
  const dvec3 a(triangle[0]), ab = dvec3(triangle[1]) - a, ac = dvec3(triangle[2]) - a, ap = p - a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return squared(ap);
  const dvec3 bp = ap - ab;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return squared(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return squared(ap - ab * (d1 > d3 ? d1 / (d1 - d3) : 0));
  const dvec3 cp = ap - ac;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return squared(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return squared(ap - ac * (d2 > d6 ? d2 / (d2 - d6) : 0));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double along = d4 - d3, all = along + d5 - d6;
    return squared(bp - (ac - ab) * (all > 0 ? along / all : 0));
  }
  return squared(ap - (ab * vb + ac * vc) / (va + vb + vc));
}

std::array<double, 4> squaredDistances(dvec3 p, const BoxGroup& boxes) {
  std::array<double, 4> sums{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t n = 0; n < 4; ++n) {
      const double x = p[int(a)];
      const double outside =
          std::max(std::max(double(boxes.low[a][n]) - x, x - double(boxes.high[a][n])), 0.0);
      sums[n] += outside * outside;
    }
  return sums;
}

BoxTree treeOf(const Surface& surface) {
  std::vector<SpaceBox> boxes(surface.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    const auto& corners = surface.triangles[t];
    const glm::vec3 a = surface.points[corners[0]], b = surface.points[corners[1]],
                    c = surface.points[corners[2]];
    boxes[t] = {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
  }
  return BoxTree(boxes);
}

// A box to search, nearest first.
struct Nearer {
  double squared;
  std::size_t box;
};

}  // namespace

struct TriangleTree::Search {
  dvec3 p;
  double best;  // squared
  std::size_t triangle;
};

TriangleTree::TriangleTree(const Surface& surface) : tree_(treeOf(surface)) {
  triangles_.reserve(surface.triangles.size());
  for (const std::uint32_t t : tree_.order()) {
    const auto& corners = surface.triangles[t];
    triangles_.push_back(
        {surface.points[corners[0]], surface.points[corners[1]], surface.points[corners[2]]});
  }
}

void TriangleTree::search(Search& search, std::size_t level, std::size_t group) const {
  const std::array<double, 4> squares = squaredDistances(search.p, tree_.group(level, group));
  std::array<Nearer, BoxTree::fanOut> nearer;  // ascending
  std::size_t count = 0;
  for (std::size_t n = 0; n < squares.size(); ++n)
    if (squares[n] < search.best) {
      std::size_t at = count++;
      for (; at > 0 && nearer[at - 1].squared > squares[n]; --at) nearer[at] = nearer[at - 1];
      nearer[at] = {squares[n], BoxTree::fanOut * group + n};
    }
  for (std::size_t n = 0; n < count && nearer[n].squared < search.best; ++n)
    if (level > 0) {
      this->search(search, level - 1, nearer[n].box);
    } else if (const double d = squaredDistance(search.p, triangles_[nearer[n].box]); d < search.best) {
      search.best = d;
      search.triangle = nearer[n].box;
    }
}

double TriangleTree::distance(dvec3 p, std::size_t& near) const {
  Search search{p, squaredDistance(p, triangles_[near]), near};
  this->search(search, tree_.levels() - 1, 0);
  near = search.triangle;
  return std::sqrt(search.best);
}

namespace {

dvec3 middleOf(const TriangleTree::Triangle& t) { return (dvec3(t[0]) + dvec3(t[1]) + dvec3(t[2])) / 3.0; }

// Runs `work` on parts of fixed size on all cores, so that results do not depend on the number of threads.
void forEachPart(std::size_t count, const CancelToken& cancel,
                 const std::function<void(std::size_t first, std::size_t end)>& work) {
  constexpr std::size_t part = 512;
  parallelFor(std::int64_t((count + part - 1) / part), 0, [&](std::int64_t begin, std::int64_t end) {
    for (auto n = std::size_t(begin); n < std::size_t(end) && !cancel.cancelled(); ++n)
      work(n * part, std::min(count, (n + 1) * part));
  });
}

// Returns the largest distance from triangle centres and corners. A corner exceeds its centre's distance by
// at most its own distance from that centre, so few corners need a query.
double largestOfCorners(const TriangleTree& of, const TriangleTree& to, const SurfaceDistances& middles,
                        const CancelToken& cancel) {
  double largest = middles.largest;
  std::mutex mutex;
  forEachPart(of.triangles().size(), cancel, [&](std::size_t first, std::size_t end) {
    double here = middles.largest;
    std::size_t near = 0;
    for (std::size_t t = first; t < end; ++t) {
      const dvec3 middle = middleOf(of.triangles()[t]);
      for (const glm::vec3& corner : of.triangles()[t])
        if (middles.ofTriangles[t] + glm::distance(dvec3(corner), middle) > here)
          here = std::max(here, to.distance(dvec3(corner), near));
    }
    const std::lock_guard lock(mutex);
    largest = std::max(largest, here);
  });
  return largest;
}

}  // namespace

SurfaceDistances distances(const TriangleTree& of, const TriangleTree& to, const CancelToken& cancel) {
  const std::size_t count = of.triangles().size();
  SurfaceDistances found{std::vector<double>(count), std::vector<double>(count), 0};
  forEachPart(count, cancel, [&](std::size_t first, std::size_t end) {
    std::size_t near = 0;
    for (std::size_t t = first; t < end; ++t) {
      const TriangleTree::Triangle& triangle = of.triangles()[t];
      const dvec3 a(triangle[0]), b(triangle[1]), c(triangle[2]);
      found.areas[t] = glm::length(glm::cross(b - a, c - a)) / 2;
      found.ofTriangles[t] = to.distance(middleOf(triangle), near);
    }
  });
  if (cancel.cancelled()) return {};
  for (const double d : found.ofTriangles) found.largest = std::max(found.largest, d);
  found.largest = largestOfCorners(of, to, found, cancel);
  return found;
}

Deviation deviation(const Surface& of, const Surface& to, const CancelToken& cancel) {
  if (of.triangles.empty() || to.triangles.empty()) return {};
  const SurfaceDistances all = distances(TriangleTree(of), TriangleTree(to), cancel);
  const double area = std::accumulate(all.areas.begin(), all.areas.end(), 0.0);
  const double sum = std::inner_product(all.areas.begin(), all.areas.end(), all.ofTriangles.begin(), 0.0);
  return {all.largest, area > 0 ? sum / area : 0};
}

}  // namespace volumen
