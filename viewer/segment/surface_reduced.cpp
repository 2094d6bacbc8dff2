#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <iterator>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "viewer/segment/surface.h"

namespace volumen {

namespace {

using glm::dmat3, glm::dvec3;
using Index = std::uint32_t;
constexpr Index nobody = std::numeric_limits<Index>::max();
constexpr double leastCosine = 0.5;  // largest turn of a normal: 60 degrees

// Sum of squared distances from planes, as the polynomial x A x + 2 b x + c.
struct Quadric {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
  dvec3 b{0};
  double c = 0;

  void addPlane(dvec3 normal, double offset) {
    xx += normal.x * normal.x, yy += normal.y * normal.y, zz += normal.z * normal.z;
    xy += normal.x * normal.y, xz += normal.x * normal.z, yz += normal.y * normal.z;
    b += normal * offset, c += offset * offset;
  }
  void add(const Quadric& q) {
    xx += q.xx, yy += q.yy, zz += q.zz, xy += q.xy, xz += q.xz, yz += q.yz;
    b += q.b, c += q.c;
  }
  dmat3 matrix() const { return {xx, xy, xz, xy, yy, yz, xz, yz, zz}; }
  double at(dvec3 x) const { return glm::dot(x, matrix() * x) + 2 * glm::dot(b, x) + c; }
};

// A candidate edge collapse, as of when it was queued.
struct Collapse {
  double cost;
  Index a, b;
  Index stamp;                               // sum of the stamps of both ends
  bool operator<(const Collapse& o) const {  // cheapest first
    return cost != o.cost ? cost > o.cost : std::pair(a, b) > std::pair(o.a, o.b);
  }
};

class Reducer {
 public:
  Reducer(Surface surface, double toleranceMm)
      : most_(toleranceMm * toleranceMm),
        middle_(surface.points.empty() ? dvec3(0) : dvec3(surface.points.front())),
        triangles_(std::move(surface.triangles)),
        quadrics_(surface.points.size()),
        stamps_(surface.points.size()),
        firstCorner_(surface.points.size(), nobody),
        nextCorner_(3 * triangles_.size()) {
    points_.reserve(surface.points.size());
    for (const glm::vec3& p : surface.points) points_.push_back(dvec3(p) - middle_);
    for (Index corner = 0; corner < nextCorner_.size(); ++corner)
      nextCorner_[corner] = std::exchange(firstCorner_[pointOf(corner)], corner);
    for (const auto& t : triangles_) addPlane(t);
  }

  void run(const CancelToken& cancel) {
    for (const auto& t : triangles_)
      for (std::size_t n = 0; n < 3; ++n)
        if (const Index a = t[n], b = t[(n + 1) % 3]; a < b) consider(a, b);
    while (!queue_.empty() && !cancel.cancelled()) {
      const Collapse next = queue_.top();
      queue_.pop();
      if (next.stamp == stamps_[next.a] + stamps_[next.b] && isThere(next.a) && isThere(next.b))
        collapse(next.a, next.b);
    }
  }

  Surface made() const {
    Surface surface;
    std::vector<Index> places(points_.size(), nobody);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (isGone(Index(t))) continue;
      std::array<Index, 3> corners;
      for (std::size_t n = 0; n < 3; ++n) {
        Index& place = places[triangles_[t][n]];
        if (place == nobody) {
          place = Index(surface.points.size());
          surface.points.emplace_back(points_[triangles_[t][n]] + middle_);
        }
        corners[n] = place;
      }
      surface.triangles.push_back(corners);
    }
    return surface;
  }

 private:
  // Corner 3 t + n is the n-th of triangle t. The corners of each point form a linked list.
  Index& pointOf(Index corner) { return triangles_[corner / 3][corner % 3]; }
  bool isGone(Index triangle) const { return triangles_[triangle][0] == triangles_[triangle][1]; }
  bool isThere(Index point) const { return firstCorner_[point] != nobody; }

  // Visits the triangles around a point and unlinks removed ones.
  template <class Visit>
  void forEachTriangle(Index point, const Visit& visit) {
    for (Index* link = &firstCorner_[point]; *link != nobody;) {
      if (isGone(*link / 3)) {
        *link = nextCorner_[*link];
        continue;
      }
      visit(*link / 3, *link % 3);
      link = &nextCorner_[*link];
    }
  }

  static dvec3 across(dvec3 a, dvec3 b, dvec3 c) { return glm::cross(b - a, c - a); }

  void addPlane(const std::array<Index, 3>& t) {
    const dvec3 normal = across(points_[t[0]], points_[t[1]], points_[t[2]]);
    const double length = glm::length(normal);
    if (!(length > 0)) return;
    const dvec3 unit = normal / length;
    for (const Index point : t) quadrics_[point].addPlane(unit, -glm::dot(unit, points_[t[0]]));
  }

  // Returns the best position of the merged point and its sum of squared distances.
  std::pair<dvec3, double> best(Index a, Index b) const {
    Quadric sum = quadrics_[a];
    sum.add(quadrics_[b]);
    const dvec3 middle = (points_[a] + points_[b]) / 2.0;
    const double reach = glm::distance(points_[a], points_[b]);
    std::pair<dvec3, double> found{middle, sum.at(middle)};
    const auto tryAt = [&](dvec3 x) {
      if (const double cost = sum.at(x); cost < found.second) found = {x, cost};
    };
    tryAt(points_[a]), tryAt(points_[b]);
    const dmat3 m = sum.matrix();
    const double size = sum.xx + sum.yy + sum.zz;
    if (const double det = glm::determinant(m); std::abs(det) > 1e-6 * size * size * size)
      if (const dvec3 x = -(glm::inverse(m) * sum.b); glm::distance(x, middle) <= 2 * reach) tryAt(x);
    return {found.first, std::max(0.0, found.second)};
  }

  void consider(Index a, Index b) {
    if (const double cost = best(a, b).second; cost <= most_)
      queue_.push({cost, std::min(a, b), std::max(a, b), stamps_[a] + stamps_[b]});
  }

  std::vector<Index> neighboursOf(Index point) {
    std::vector<Index> all;
    forEachTriangle(point, [&](Index t, Index corner) {
      all.push_back(triangles_[t][(corner + 1) % 3]);  // closed: each neighbour is once the next corner
    });
    std::ranges::sort(all);
    return all;
  }

  // Link condition: the ends share only the two opposite corners, and these have further neighbours.
  bool staysClosed(Index a, Index b) {
    const std::vector<Index> ofA = neighboursOf(a), ofB = neighboursOf(b);
    std::vector<Index> common;
    std::ranges::set_intersection(ofA, ofB, std::back_inserter(common));
    return common.size() == 2 && ofA.size() + ofB.size() > 6 && neighboursOf(common[0]).size() > 3 &&
           neighboursOf(common[1]).size() > 3;
  }

  // Returns whether triangles around `point`, moved to x, keep their orientation. Those with `other` vanish.
  bool staysUpright(Index point, Index other, dvec3 x) {
    bool upright = true;
    forEachTriangle(point, [&](Index t, Index corner) {
      const Index p = triangles_[t][(corner + 1) % 3], q = triangles_[t][(corner + 2) % 3];
      if (!upright || p == other || q == other) return;
      const dvec3 before = across(points_[point], points_[p], points_[q]);
      const dvec3 after = across(x, points_[p], points_[q]);
      upright = glm::dot(before, after) > leastCosine * glm::length(before) * glm::length(after);
    });
    return upright;
  }

  void collapse(Index a, Index b) {
    const dvec3 x = best(a, b).first;
    if (!staysClosed(a, b) || !staysUpright(a, b, x) || !staysUpright(b, a, x)) return;
    Index last = nobody;
    forEachTriangle(b, [&](Index t, Index corner) {
      triangles_[t][corner] = a;
      auto& corners = triangles_[t];
      if (std::ranges::count(corners, a) > 1) corners.fill(a);  // removed
      last = 3 * t + corner;
    });
    nextCorner_[last] = std::exchange(firstCorner_[a], std::exchange(firstCorner_[b], nobody));
    points_[a] = x;
    quadrics_[a].add(quadrics_[b]);
    ++stamps_[a];
    for (const Index neighbour : neighboursOf(a)) consider(a, neighbour);
  }

  double most_;   // mm^2
  dvec3 middle_;  // points are relative to it, for precision
  std::vector<std::array<Index, 3>> triangles_;
  std::vector<dvec3> points_;
  std::vector<Quadric> quadrics_;
  std::vector<Index> stamps_;  // number of changes of a point
  std::vector<Index> firstCorner_, nextCorner_;
  std::priority_queue<Collapse> queue_;
};

}  // namespace

Surface reduced(Surface surface, double toleranceMm, const CancelToken& cancel) {
  Reducer reducer(std::move(surface), toleranceMm);
  reducer.run(cancel);
  return reducer.made();
}

}  // namespace volumen
