#include "viewer/kernels/segment_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace volumen {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// A cubic over s = 0 .. 1, in ascending powers.
using Cubic = glm::dvec4;
double valueOf(const Cubic& c, double s) { return ((c[3] * s + c[2]) * s + c[1]) * s + c[0]; }
double slopeOf(const Cubic& c, double s) { return (3 * c[3] * s + 2 * c[2]) * s + c[1]; }

// Returns the root of c between `low` and `high`, where its sign changes. Uses Newton's method, with
// bisection where a step leaves the bracket.
double rootBetween(const Cubic& c, double low, double high, bool startsAbove) {
  constexpr double close = 1e-9;
  const double atLow = valueOf(c, low), atHigh = valueOf(c, high);
  double s = (low + high) / 2;
  if ((atLow >= 0) != (atHigh >= 0)) s = low + (high - low) * (atLow / (atLow - atHigh));
  for (int n = 0; n < 60 && high - low > close; ++n) {
    const double value = valueOf(c, s);
    ((value >= 0) == startsAbove ? low : high) = s;
    double next = s - value / slopeOf(c, s);
    if (!(next > low && next < high)) next = (low + high) / 2;
    const double moved = std::abs(next - s);
    s = next;
    if (moved < close) break;
  }
  return s;
}

// Finds where a cubic's slope is 0 in (0, 1), in order. Returns how many such places there are.
int extremesOf(const Cubic& c, double places[2]) {
  const double a = 3 * c[3], b = c[2], d = c[1];  // a s^2 + 2 b s + d
  const double root2 = b * b - a * d;
  if (!(root2 > 0)) return 0;
  const double q = -(b + std::copysign(std::sqrt(root2), b));
  int count = 0;
  for (const double s : {q / a, d / q})
    if (s > 0 && s < 1) places[count++] = s;
  if (count == 2 && places[0] > places[1]) std::swap(places[0], places[1]);
  return count;
}

// Returns true if all Bezier control points, and thus the cubic, lie on the given side of 0.
bool staysOn(const Cubic& c, bool above) {
  const double points[] = {c[0], c[0] + c[1] / 3, c[0] + (2 * c[1] + c[2]) / 3, c[0] + c[1] + c[2] + c[3]};
  return std::ranges::all_of(points, [above](double p) { return (p >= 0) == above; });
}

class CrossingWalk {
 public:
  CrossingWalk(const SegmentCells& cells, const FieldLine& line, int most,
               std::vector<FieldCrossing>& crossings)
      : cells_(cells),
        values_(cells.field()->values.data()),
        line_(line),
        inverse_(1.0 / line.move),
        left_(most),
        crossings_(crossings) {
    for (int a = 0; a < 3; ++a) step_[a] = line.move[a] > 0 ? 1 : -1;
    const glm::i64vec3 size = cells.field()->size();
    rowStride_ = size.x, sliceStride_ = size.x * size.y;
  }

  void walk(double t0, double t1) {
    const VoxelBox& box = cells_.box();
    for (int a = 0; a < 3; ++a) {
      const double low = box.low[a], high = box.high[a] + 1;
      if (line_.move[a] == 0) {
        if (line_.origin[a] < low || line_.origin[a] > high) return;
        continue;
      }
      const double tLow = (low - line_.origin[a]) * inverse_[a],
                   tHigh = (high - line_.origin[a]) * inverse_[a];
      t0 = std::max(t0, std::min(tLow, tHigh));
      t1 = std::min(t1, std::max(tLow, tHigh));
    }
    if (t1 > t0) walkBlocks(t0, t1);
  }

 private:
  static constexpr int blockEdge = SegmentCells::edge;

  // The cubes that the line passes, one after another, and where it leaves each.
  template <int kEdge>
  struct CubeWalk {
    CubeWalk(const CrossingWalk& walk, double t, glm::ivec3 low, glm::ivec3 high) : walk_(walk) {
      enterAt(t, low, high);
    }
    void enterAt(double t, glm::ivec3 low, glm::ivec3 high) {
      const glm::dvec3 at = (walk_.line_.origin + t * walk_.line_.move) * (1.0 / kEdge);
      cube = glm::ivec3(glm::clamp(at, glm::dvec3(low), glm::dvec3(high)));
      for (int a = 0; a < 3; ++a)
        next[a] = walk_.line_.move[a] == 0 ? never : walk_.planeAt<kEdge>(a, cube[a] + (walk_.step_[a] > 0));
    }
    int axis() const { return next.x <= next.y ? (next.x <= next.z ? 0 : 2) : (next.y <= next.z ? 1 : 2); }
    void advance(int a) {
      cube[a] += walk_.step_[a];
      next[a] = walk_.planeAt<kEdge>(a, cube[a] + (walk_.step_[a] > 0));
    }
    const CrossingWalk& walk_;
    glm::ivec3 cube{0};
    glm::dvec3 next{0};  // t of the next plane along each axis
  };

  void walkBlocks(double t, double t1) {
    const glm::ivec3 low = cells_.box().low / blockEdge, high = cells_.box().high / blockEdge;
    const glm::dvec3 moves = glm::abs(line_.move);
    const double blockMm = blockEdge / std::max({moves.x, moves.y, moves.z});
    CubeWalk<blockEdge> walk(*this, t, low, high);
    while (t < t1) {
      // Where t is so large that the addition changes nothing, only planes lead on.
      const double farther = t + (cells_.distance(walk.cube) - 1) * blockMm;
      if (farther > t) {
        t = farther;
        walk.enterAt(t, low, high);
        continue;
      }
      const int axis = walk.axis();
      const double end = std::min(walk.next[axis], t1);
      if (const std::uint64_t bits = cells_.block(walk.cube); bits && end > t)
        if (!walkCells(walk.cube * blockEdge, bits, t, end)) return;
      t = std::max(t, walk.next[axis]);
      walk.advance(axis);
      if (walk.cube[axis] < low[axis] || walk.cube[axis] > high[axis]) return;
    }
  }

  // Returns false once `most` crossings are found. Adjoining cells get the same t where they meet, also
  // across blocks.
  bool walkCells(glm::ivec3 low, std::uint64_t bits, double t, double t1) {
    const glm::ivec3 high = low + (blockEdge - 1);
    CubeWalk<1> walk(*this, t, low, high);
    while (t < t1) {
      const int axis = walk.axis();
      const double end = std::min(walk.next[axis], t1);
      if (end > t && (bits & SegmentCells::bitOf(walk.cube)) && !lookInto(walk.cube, t, end)) return false;
      t = std::max(t, walk.next[axis]);
      walk.advance(axis);
      if (walk.cube[axis] < low[axis] || walk.cube[axis] > high[axis]) return true;
    }
    return true;
  }

  template <int kEdge>
  double planeAt(int axis, int n) const {
    return (double(n * kEdge) - line_.origin[axis]) * inverse_[axis];
  }

  // Returns the field minus 1/2 along the part of the line in a cell.
  Cubic fieldAlong(glm::ivec3 cell, double t0, double t1) const {
    const glm::dvec3 start = line_.origin + t0 * line_.move - glm::dvec3(cell), move = (t1 - t0) * line_.move;
    const float* v = values_ + (cell.z * sliceStride_ + cell.y * rowStride_ + cell.x);
    const auto alongX = [&](const float* row) {
      const double by = double(row[1]) - row[0];
      return glm::dvec2(row[0] - double(SegmentCells::level) + start.x * by, move.x * by);
    };
    const auto alongY = [&](const float* slice) {
      const glm::dvec2 a = alongX(slice), by = alongX(slice + rowStride_) - a;
      return glm::dvec3(a + start.y * by, 0) + glm::dvec3(0, move.y * by);
    };
    const glm::dvec3 a = alongY(v), by = alongY(v + sliceStride_) - a;
    return glm::dvec4(a + start.z * by, 0) + glm::dvec4(0, move.z * by);
  }

  // Returns false once `most` crossings are found. Rounding neither adds nor loses crossings at the end of a
  // cell: a cell starts inside or outside as the line left the last one.
  bool lookInto(glm::ivec3 cell, double t0, double t1) {
    const Cubic f = fieldAlong(cell, t0, t1);
    bool isInside = t0 == lastEnd_ ? wasInside_ : f[0] >= 0;
    lastEnd_ = t1, wasInside_ = isInside;
    if (staysOn(f, isInside)) return true;
    double stops[4] = {0};
    const int count = 1 + extremesOf(f, stops + 1);
    stops[count] = 1;
    for (int n = 0; n < count; ++n) {
      const bool inside = valueOf(f, stops[n + 1]) >= 0;
      if (inside == isInside) continue;
      const double s = rootBetween(f, stops[n], stops[n + 1], isInside);
      crossings_.push_back({t0 + s * (t1 - t0), isInside});
      if (--left_ == 0) return false;
      isInside = inside;
    }
    wasInside_ = isInside;
    return true;
  }

  const SegmentCells& cells_;
  const float* values_;
  const FieldLine& line_;
  const glm::dvec3 inverse_;
  glm::ivec3 step_{1};
  int left_;  // Number of crossings still wanted.
  std::vector<FieldCrossing>& crossings_;
  std::int64_t rowStride_ = 0, sliceStride_ = 0;
  double lastEnd_ = -never;  // End of the cell searched last.
  bool wasInside_ = false;
};

/// Weights of voxels -1, 0, 1 and 2 for Sobel values interpolated between 0 and 1.
struct SobelWeights {
  std::array<double, 4> smooth, derivative;
  explicit SobelWeights(double f)
      : smooth{(1 - f) / 4, (1 - f) / 2 + f / 4, (1 - f) / 4 + f / 2, f / 4},
        derivative{(f - 1) / 2, -f / 2, (1 - f) / 2, f / 2} {}
};

}  // namespace

void appendCrossings(const SegmentCells& cells, const FieldLine& line, double t0, double t1, int most,
                     std::vector<FieldCrossing>& crossings) {
  CrossingWalk(cells, line, most, crossings).walk(t0, t1);
}

glm::dvec3 fieldGradient(const OccupancyField& field, glm::dvec3 place) {
  const glm::ivec3 size = field.size(),
                   cell(glm::clamp(glm::floor(place), glm::dvec3(0), glm::dvec3(size - 2)));
  const glm::dvec3 f = place - glm::dvec3(cell);
  const SobelWeights x(f.x), y(f.y), z(f.z);
  const glm::ivec3 low = glm::max(glm::ivec3(0), cell - 1), high = glm::min(size - 1, cell + 2);
  glm::dvec3 sum(0);
  for (int k = low.z; k <= high.z; ++k) {
    glm::dvec3 inSlice(0);
    for (int j = low.y; j <= high.y; ++j) {
      const float* row = field.values.data() + (std::int64_t(k) * size.y + j) * size.x;
      double smooth = 0, derivative = 0;
      for (int i = low.x; i <= high.x; ++i) {
        const auto n = std::size_t(i - cell.x + 1);
        smooth += x.smooth[n] * row[i];
        derivative += x.derivative[n] * row[i];
      }
      const auto n = std::size_t(j - cell.y + 1);
      inSlice += glm::dvec3(derivative * y.smooth[n], smooth * y.derivative[n], smooth * y.smooth[n]);
    }
    const auto n = std::size_t(k - cell.z + 1);
    sum += inSlice * glm::dvec3(z.smooth[n], z.smooth[n], z.derivative[n]);
  }
  return sum;
}

}  // namespace volumen
