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

// The s at which c is 0, one of whose ends lies above and the other not: Newton's steps, halves where they
// leave the bracket.
double rootBetween(const Cubic& c, double low, double high, bool startsAbove) {
  constexpr double close = 1e-12;
  double s = (low + high) / 2;
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

// Where a cubic's slope is 0 in (0, 1), in order; how many.
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

class CrossingWalk {
 public:
  CrossingWalk(const SegmentCells& cells, const FieldLine& line, bool onlyFirst,
               std::vector<FieldCrossing>& crossings)
      : cells_(cells),
        values_(cells.field()->values.data()),
        line_(line),
        inverse_(1.0 / line.move),
        onlyFirst_(onlyFirst),
        crossings_(crossings) {
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
    if (!(t1 > t0)) return;
    constexpr int blockEdge = SegmentCells::edge, regionEdge = blockEdge * SegmentCells::edge;
    walkCubes<regionEdge>(
        box.low / regionEdge, box.high / regionEdge, t0, t1, [&](glm::ivec3 region, double r0, double r1) {
          const std::uint64_t blocks = cells_.region(region);
          return !blocks || walkCubes<blockEdge>(region * SegmentCells::edge, region * SegmentCells::edge + 3,
                                                 r0, r1, [&](glm::ivec3 block, double b0, double b1) {
                                                   if (!(blocks & SegmentCells::bitOf(block))) return true;
                                                   const std::uint64_t bits = cells_.block(block);
                                                   return walkCubes<1>(
                                                       block * blockEdge, block * blockEdge + (blockEdge - 1),
                                                       b0, b1, [&](glm::ivec3 cell, double c0, double c1) {
                                                         return !(bits & SegmentCells::bitOf(cell)) ||
                                                                lookInto(cell, c0, c1);
                                                       });
                                                 });
        });
  }

 private:
  // Calls visit(cube, t of entry, of exit) for the cubes from `low` to `high` along the line from t0 to t1,
  // while it returns true; false where it did not. Where cubes meet they get the same t, whatever their edge.
  template <int kEdge, class Visit>
  bool walkCubes(glm::ivec3 low, glm::ivec3 high, double t0, double t1, const Visit& visit) const {
    const glm::dvec3 start = (line_.origin + t0 * line_.move) * (1.0 / kEdge);
    glm::ivec3 cube = glm::clamp(glm::ivec3(glm::floor(start)), low, high);
    glm::dvec3 next(never);
    glm::ivec3 step(0);
    for (int a = 0; a < 3; ++a) {
      if (line_.move[a] == 0) continue;
      step[a] = line_.move[a] > 0 ? 1 : -1;
      next[a] = planeAt<kEdge>(a, cube[a] + (step[a] > 0));
    }
    for (double t = t0;;) {
      const int axis = next.x <= next.y ? (next.x <= next.z ? 0 : 2) : (next.y <= next.z ? 1 : 2);
      const double end = std::min(next[axis], t1);
      if (end > t && !visit(cube, t, end)) return false;
      if (next[axis] >= t1) return true;
      t = std::max(t, end);
      cube[axis] += step[axis];
      if (cube[axis] < low[axis] || cube[axis] > high[axis]) return true;
      next[axis] = planeAt<kEdge>(axis, cube[axis] + (step[axis] > 0));
    }
  }
  template <int kEdge>
  double planeAt(int axis, int n) const {
    return (double(n * kEdge) - line_.origin[axis]) * inverse_[axis];
  }

  // The field less 1/2 along the part of the line in a cell.
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

  // False where no more is asked for. Rounding makes no crossing at the end of a cell, and loses none: where
  // one begins the line is still inside, or outside, as it left the last.
  bool lookInto(glm::ivec3 cell, double t0, double t1) {
    const Cubic f = fieldAlong(cell, t0, t1);
    bool isInside = t0 == lastEnd_ ? wasInside_ : f[0] >= 0;
    double stops[4] = {0};
    const int count = 1 + extremesOf(f, stops + 1);
    stops[count] = 1;
    lastEnd_ = t1;
    for (int n = 0; n < count; ++n) {
      const bool inside = valueOf(f, stops[n + 1]) >= 0;
      if (inside == isInside) continue;
      const double s = rootBetween(f, stops[n], stops[n + 1], isInside);
      crossings_.push_back({t0 + s * (t1 - t0), isInside});
      if (onlyFirst_) return false;
      isInside = inside;
    }
    wasInside_ = isInside;
    return true;
  }

  const SegmentCells& cells_;
  const float* values_;
  const FieldLine& line_;
  const glm::dvec3 inverse_;
  const bool onlyFirst_;
  std::vector<FieldCrossing>& crossings_;
  std::int64_t rowStride_ = 0, sliceStride_ = 0;
  double lastEnd_ = -never;  // of the cell last looked into
  bool wasInside_ = false;
};

/// What voxels -1, 0, 1 and 2 count for between 0 and 1: their Sobel values, interpolated.
struct SobelWeights {
  std::array<double, 4> smooth, derivative;
  explicit SobelWeights(double f)
      : smooth{(1 - f) / 4, (1 - f) / 2 + f / 4, (1 - f) / 4 + f / 2, f / 4},
        derivative{(f - 1) / 2, -f / 2, (1 - f) / 2, f / 2} {}
};

}  // namespace

void appendCrossings(const SegmentCells& cells, const FieldLine& line, double t0, double t1, bool onlyFirst,
                     std::vector<FieldCrossing>& crossings) {
  CrossingWalk(cells, line, onlyFirst, crossings).walk(t0, t1);
}

glm::dvec3 fieldGradient(const OccupancyField& field, glm::dvec3 place) {
  const glm::ivec3 size = field.size(),
                   cell = glm::clamp(glm::ivec3(glm::floor(place)), glm::ivec3(0), size - 2);
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
