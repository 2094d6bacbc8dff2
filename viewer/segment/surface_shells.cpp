#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>

#include "viewer/segment/surface.h"

namespace volumen {

namespace {

// Union-find over the points of each shell.
class PointTrees {
 public:
  explicit PointTrees(std::size_t count) : above_(count) { std::iota(above_.begin(), above_.end(), 0u); }

  std::uint32_t rootOf(std::uint32_t point) {
    while (above_[point] != point) point = above_[point] = above_[above_[point]];
    return point;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t first = rootOf(a), second = rootOf(b);
    above_[std::max(first, second)] = std::min(first, second);
  }

 private:
  std::vector<std::uint32_t> above_;
};

}  // namespace

std::vector<double> shellVolumes(const Surface& surface) {
  PointTrees trees(surface.points.size());
  for (const auto& t : surface.triangles) trees.join(t[0], t[1]), trees.join(t[0], t[2]);
  std::vector<double> ofRoot(surface.points.size());
  for (const auto& t : surface.triangles) {
    const std::uint32_t root = trees.rootOf(t[0]);
    const glm::dvec3 o(surface.points[root]);  // nearby origin, for precision
    const auto at = [&](std::size_t n) { return glm::dvec3(surface.points[t[n]]) - o; };
    ofRoot[root] += glm::dot(at(0), glm::cross(at(1), at(2))) / 6;
  }
  std::vector<double> volumes;
  for (std::uint32_t point = 0; point < surface.points.size(); ++point)
    if (trees.rootOf(point) == point) volumes.push_back(ofRoot[point]);
  std::ranges::sort(volumes, std::greater());
  return volumes;
}

}  // namespace volumen
