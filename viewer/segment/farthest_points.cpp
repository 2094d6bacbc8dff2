#include "viewer/segment/farthest_points.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

#include "viewer/segment/box_tree.h"

namespace volumen {

namespace {

using glm::dvec3;

double squareOf(dvec3 v) { return glm::dot(v, v); }

// A pair of boxes to search, farthest first.
struct Farther {
  double squared;
  std::size_t first, second;
};

// Finds the two farthest points by branch and bound over pairs of boxes of one level.
class FarthestPair {
 public:
  explicit FarthestPair(std::span<const glm::vec3> points)
      : points_(points), tree_(boxesOf(points)), found_{points[0], points[0]} {}

  std::array<glm::vec3, 2> find() {
    search(tree_.levels() - 1, 0, 0);
    return found_;
  }

 private:
  static std::vector<SpaceBox> boxesOf(std::span<const glm::vec3> points) {
    std::vector<SpaceBox> boxes;
    boxes.reserve(points.size());
    for (const glm::vec3& p : points) boxes.push_back({p, p});
    return boxes;
  }
  // Returns an upper bound of the squared distance between points of the two boxes.
  double bound(std::size_t level, std::size_t n, std::size_t m) const {
    const BoxGroup& a = tree_.group(level, n / BoxTree::fanOut);
    const BoxGroup& b = tree_.group(level, m / BoxTree::fanOut);
    dvec3 apart;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto lowA = double(a.low[c][n % BoxTree::fanOut]), highA = double(a.high[c][n % BoxTree::fanOut]);
      const auto lowB = double(b.low[c][m % BoxTree::fanOut]), highB = double(b.high[c][m % BoxTree::fanOut]);
      apart[int(c)] = std::max(highA - lowB, highB - lowA);
    }
    return squareOf(apart);
  }

  // Searches the boxes of two groups of a level.
  void search(std::size_t level, std::size_t a, std::size_t b) {
    std::array<Farther, BoxTree::fanOut * BoxTree::fanOut> farther;
    std::size_t count = 0;
    forEachPair(a, b, tree_.boxes(level), [&](std::size_t n, std::size_t m) {
      if (const double d = bound(level, n, m); d > best_) farther[count++] = {d, n, m};
    });
    std::sort(farther.begin(), farther.begin() + std::ptrdiff_t(count),
              [](const Farther& x, const Farther& y) {
                return x.squared != y.squared ? x.squared > y.squared
                                              : std::pair(x.first, x.second) < std::pair(y.first, y.second);
              });
    for (std::size_t n = 0; n < count && farther[n].squared > best_; ++n)
      if (level > 0) {
        search(level - 1, farther[n].first, farther[n].second);
      } else {
        best_ = farther[n].squared;  // boxes of level 0 are points
        found_ = {points_[tree_.order()[farther[n].first]], points_[tree_.order()[farther[n].second]]};
      }
  }
  // Visits all pairs of boxes of two groups, each pair once.
  template <class Visit>
  static void forEachPair(std::size_t a, std::size_t b, std::size_t count, const Visit& visit) {
    constexpr std::size_t fan = BoxTree::fanOut;
    for (std::size_t n = a * fan; n < std::min(count, (a + 1) * fan); ++n)
      for (std::size_t m = a == b ? n : b * fan; m < std::min(count, (b + 1) * fan); ++m) visit(n, m);
  }

  std::span<const glm::vec3> points_;
  BoxTree tree_;
  double best_ = 0;
  std::array<glm::vec3, 2> found_;
};

}  // namespace

std::array<glm::vec3, 2> farthestPoints(const Surface& surface) {
  return FarthestPair(surface.points).find();
}

}  // namespace volumen
