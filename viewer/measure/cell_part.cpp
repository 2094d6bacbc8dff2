#include "viewer/measure/cell_part.h"

#include <algorithm>
#include <cmath>

namespace volumen {

namespace {

constexpr int deepest = 16;  ///< Largest number of times that a square is quartered.

// The values at the two ends of a line, between which the value is linear.
struct Line {
  double from, to;

  double partInside(ValueRange range) const {
    if (from == to) return from >= range.low && from <= range.high ? 1 : 0;
    const double a = (range.low - from) / (to - from), b = (range.high - from) / (to - from);
    return std::max(0.0, std::min(1.0, std::max(a, b)) - std::max(0.0, std::min(a, b)));
  }
};

class Cell {
 public:
  Cell(const std::array<double, 8>& corners, ValueRange range, double tolerance)
      : range_(range), tolerance_(tolerance) {
    const int along = steepestAxis(corners);
    for (int n = 0; n < 4; ++n) {
      const int a = (n & 1) << (along + 1) % 3 | (n >> 1) << (along + 2) % 3;
      lines_[n] = {corners[a], corners[a | 1 << along]};
    }
  }

  Part wholePart() const { return refined(0, 0, 1, estimate(0, 0, 1), 0); }

 private:
  static int steepestAxis(const std::array<double, 8>& corners) {
    double change[3] = {};
    for (int n = 0; n < 8; ++n)
      for (int a = 0; a < 3; ++a) change[a] += std::abs(corners[n] - corners[n ^ 1 << a]);
    return int(std::max_element(change, change + 3) - change);
  }

  Line lineAt(double y, double z) const {
    const auto between = [](double a, double b, double t) { return a + t * (b - a); };
    const auto end = [&](double Line::*e) {
      return between(between(lines_[0].*e, lines_[1].*e, y), between(lines_[2].*e, lines_[3].*e, y), z);
    };
    return {end(&Line::from), end(&Line::to)};
  }

  // The fraction for a square, from the lines at its corners and in its middle.
  struct Estimate {
    double part;
    bool exact;
  };

  Estimate estimate(double y, double z, double edge) const {
    const Line corners[] = {lineAt(y, z), lineAt(y + edge, z), lineAt(y, z + edge),
                            lineAt(y + edge, z + edge)};
    // A trilinear value lies between its smallest and largest corner.
    double low = corners[0].from, high = low, outer = 0;
    for (const Line& line : corners) {
      low = std::min({low, line.from, line.to});
      high = std::max({high, line.from, line.to});
    }
    if (low >= range_.low && high <= range_.high) return {1, true};
    if (high < range_.low || low > range_.high) return {0, true};
    for (const Line& line : corners) outer += line.partInside(range_) / 4;
    const double middle = lineAt(y + edge / 2, z + edge / 2).partInside(range_);
    // Where the fraction bends evenly, the corners' error is twice the middle's, with the opposite sign.
    return {(2 * middle + outer) / 3, false};
  }

  Part refined(double y, double z, double edge, Estimate whole, int depth) const {
    const double area = edge * edge, half = edge / 2;
    if (whole.exact) return {whole.part * area, 0};
    Estimate quarters[4];
    double mean = 0;
    for (int n = 0; n < 4; ++n) {
      quarters[n] = estimate(y + (n & 1) * half, z + (n >> 1) * half, half);
      mean += quarters[n].part / 4;
    }
    const double error = std::abs(mean - whole.part);
    const bool noLineTells = mean == 0 || mean == 1;
    if ((error * edge <= tolerance_ && !(noLineTells && depth < 4)) || depth == deepest)
      return {mean * area, error * area};
    Part sum;
    for (int n = 0; n < 4; ++n)
      sum += refined(y + (n & 1) * half, z + (n >> 1) * half, half, quarters[n], depth + 1);
    return sum;
  }

  std::array<Line, 4> lines_;  // Along the axis of the largest change of value; y fastest, then z.
  ValueRange range_;
  double tolerance_;
};

}  // namespace

Part partInRange(const std::array<double, 8>& corners, ValueRange range, double tolerance) {
  return Cell(corners, range, tolerance).wholePart();
}

}  // namespace volumen
