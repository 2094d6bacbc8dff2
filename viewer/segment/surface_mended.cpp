#include "viewer/segment/surface_mended.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace volumen {

namespace {

using glm::dvec3, glm::ivec3;

constexpr double thinBelow = 0.5;      // quality below which triangles are mended
constexpr int mostPasses = 6;          // only noise needs as many passes
constexpr double leastGain = 0.02;     // least gain in quality for which a point is moved
constexpr double leastUpright = 0.35;  // cosine between a triangle and the surface at a moved point
constexpr double farthestOff = 0.49;   // voxels from the border; segment.md promises 1/2
constexpr double mostOffLevel = 0.03;  // largest change of the field (0 to 1) at a moved point

double qualityOf(dvec3 a, dvec3 b, dvec3 c) {
  const dvec3 u = b - a, v = c - b, w = a - c;
  const double squares = glm::dot(u, u) + glm::dot(v, v) + glm::dot(w, w);
  return squares > 0 ? 2 * std::numbers::sqrt3 * glm::length(glm::cross(u, v)) / squares : 0;
}

// The cell of a field that contains a point, in voxels.
class FieldCell {
 public:
  FieldCell(const OccupancyField& field, dvec3 pVoxel) {
    const ivec3 size = field.size();
    low_ = glm::clamp(ivec3(glm::floor(pVoxel)), field.box.low, field.box.high - 1);
    at_ = pVoxel - dvec3(low_);
    const glm::i64vec3 first = low_ - field.box.low;
    for (std::size_t c = 0; c < 8; ++c) {
      const glm::i64vec3 x = first + glm::i64vec3(c & 1, c >> 1 & 1, c >> 2);
      corners_[c] = double(field.values[std::size_t((x.z * size.y + x.y) * size.x + x.x)]);
    }
  }

  double value() const {
    double sum = 0;
    for (std::size_t c = 0; c < 8; ++c) sum += corners_[c] * share(c, 0) * share(c, 1) * share(c, 2);
    return sum;
  }
  // Returns the distance to the voxel border in the cell; infinite if none crosses it.
  double fromBorder() const {
    double nearest = HUGE_VAL;
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t c = 0; c < 8; ++c) {
        if (c >> axis & 1 || isIn(c) == isIn(c | std::size_t(1) << axis)) continue;
        dvec3 beyond(0);
        for (int a = 0; a < 3; ++a) beyond[a] = std::max(std::abs(at_[a] - double(c >> a & 1)) - 0.5, 0.0);
        beyond[axis] = at_[axis] - 0.5;
        nearest = std::min(nearest, glm::dot(beyond, beyond));
      }
    return std::sqrt(nearest);
  }

 private:
  bool isIn(std::size_t corner) const { return corners_[corner] >= 0.5; }
  double share(std::size_t corner, int axis) const { return corner >> axis & 1 ? at_[axis] : 1 - at_[axis]; }

  ivec3 low_;
  dvec3 at_;
  std::array<double, 8> corners_{};
};

// Moves points along the surface, one after another, wherever this improves the worst triangle around them.
class Mender {
 public:
  Mender(Surface& surface, const OccupancyField& field)
      : surface_(surface), field_(field), rests_(surface.points.size()) {
    first_.assign(surface.points.size() + 1, 0);
    for (const auto& t : surface.triangles)
      for (const std::uint32_t p : t) ++first_[p + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    about_.resize(3 * surface.triangles.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
      for (const std::uint32_t p : surface.triangles[t]) about_[next[p]++] = t;
  }

  void run(const CancelToken& cancel) {
    for (int pass = 0; pass < mostPasses && !cancel.cancelled(); ++pass) {
      std::size_t moved = 0;
      for (const auto& t : surface_.triangles) {
        for (std::size_t n = 0; n < 3 && qualityOf(at(t[0]), at(t[1]), at(t[2])) < thinBelow; ++n)
          moved += !rests_[t[n]] && move(t[n]);
        if (cancel.cancelled()) return;
      }
      if (moved == 0) return;
    }
  }

 private:
  dvec3 at(std::uint32_t point) const { return dvec3(surface_.points[point]); }
  std::span<const std::uint32_t> trianglesAbout(std::uint32_t point) const {
    return std::span(about_).subspan(first_[point], first_[point + 1] - first_[point]);
  }
  FieldCell cellAt(dvec3 p) const { return FieldCell(field_, toVoxels_ * (p - field_.geometry.origin)); }
  // Returns the corners of a triangle with `point` moved to p.
  std::array<dvec3, 3> cornersWith(std::uint32_t triangle, std::uint32_t point, dvec3 p) const {
    std::array<dvec3, 3> corners;
    for (std::size_t n = 0; n < 3; ++n) {
      const std::uint32_t corner = surface_.triangles[triangle][n];
      corners[n] = corner == point ? p : at(corner);
    }
    return corners;
  }
  // Returns twice the area vector, outwards, of the triangles around a point. It does not depend on the
  // position of the point. Only moves along it change the enclosed volume.
  dvec3 outwardsAt(std::uint32_t point) const {
    dvec3 sum(0);
    for (const std::uint32_t t : trianglesAbout(point)) {
      const auto [a, b, c] = cornersWith(t, point, at(point));
      sum += glm::cross(b - a, c - a);
    }
    return sum;
  }
  // Returns the quality of the worst triangle around a point at p; negative if one is no longer upright.
  double worstAbout(std::uint32_t point, dvec3 p, dvec3 outwards) const {
    double worst = 1;
    for (const std::uint32_t t : trianglesAbout(point)) {
      const auto [a, b, c] = cornersWith(t, point, p);
      const dvec3 across = glm::cross(b - a, c - a);
      if (glm::dot(across, outwards) < leastUpright * glm::length(across) * glm::length(outwards)) return -1;
      worst = std::min(worst, qualityOf(a, b, c));
    }
    return worst;
  }
  // Returns whether all triangles around a point at p stay near the voxel border.
  bool liesNearBorder(std::uint32_t point, dvec3 p) const {
    constexpr int parts = 6;
    for (const std::uint32_t t : trianglesAbout(point)) {
      const auto [a, b, c] = cornersWith(t, point, p);
      for (int i = 0; i <= parts; ++i)
        for (int j = 0; i + j <= parts; ++j) {
          const dvec3 place = (double(i) * a + double(j) * b + double(parts - i - j) * c) / double(parts);
          if (!(cellAt(place).fromBorder() < farthestOff)) return false;
        }
    }
    return true;
  }
  bool move(std::uint32_t point) {
    const dvec3 p = at(point), outwards = outwardsAt(point);
    const double size = glm::dot(outwards, outwards);
    if (!(size > 0)) return false;
    dvec3 middle(0);
    for (const std::uint32_t t : trianglesAbout(point))
      for (const std::uint32_t corner : surface_.triangles[t]) middle += at(corner) - p;
    middle /= 2.0 * double(trianglesAbout(point).size());  // each neighbour is in two triangles
    const dvec3 along = middle - glm::dot(middle, outwards) / size * outwards;
    const double before = worstAbout(point, p, outwards), value = cellAt(p).value();
    for (const double part : {1.0, 0.6, 0.3}) {
      const dvec3 to(glm::vec3(p + part * along));  // rounded as points are stored
      if (worstAbout(point, to, outwards) < std::max(before, 0.0) + leastGain) continue;
      if (std::abs(cellAt(to).value() - value) > mostOffLevel || !liesNearBorder(point, to)) continue;
      surface_.points[point] = glm::vec3(to);
      for (const std::uint32_t t : trianglesAbout(point))
        for (const std::uint32_t corner : surface_.triangles[t]) rests_[corner] = false;
      return true;
    }
    rests_[point] = true;
    return false;
  }

  Surface& surface_;
  const OccupancyField& field_;
  std::vector<char> rests_;  // points that cannot move until a neighbour has
  const glm::dmat3 toVoxels_ = field_.geometry.voxelFromPatientStep();
  std::vector<std::uint32_t> first_, about_;  // triangles around each point: first index, and list
};

}  // namespace

Surface mended(Surface surface, const OccupancyField& field, const CancelToken& cancel) {
  Mender(surface, field).run(cancel);
  return surface;
}

}  // namespace volumen
