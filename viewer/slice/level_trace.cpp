#include "viewer/slice/level_trace.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace volumen {

namespace {

constexpr double belowAny = -std::numeric_limits<double>::infinity();
// Fraction of the way between two pixels that keeps the line off the pixels.
constexpr double leastWay = 0.02;

// Two neighbouring pixels, the first inside and the second outside: the contour crosses between them.
struct TraceCrossing {
  glm::ivec2 in, out;
  bool operator==(const TraceCrossing&) const = default;
};

// Rotates by a quarter turn.
glm::ivec2 quarterTurned(glm::ivec2 step) { return {-step.y, step.x}; }

class LevelLines {
 public:
  LevelLines(const SliceValues& slice, double level) : slice_(slice), level_(level) {}

  // Returns the crossing nearest to a point, the first of equal ones.
  std::optional<TraceCrossing> nearest(glm::dvec2 at) const;
  // Returns all points of the contour through a crossing.
  std::vector<glm::dvec2> lineFrom(const TraceCrossing& first) const;

 private:
  double value(glm::ivec2 pixel) const {
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= slice_.size.x || pixel.y >= slice_.size.y) return belowAny;
    const float v = slice_.values[std::size_t(pixel.y) * std::size_t(slice_.size.x) + std::size_t(pixel.x)];
    return std::isnan(v) ? belowAny : double(v);
  }
  bool isIn(glm::ivec2 pixel) const { return value(pixel) >= level_; }

  glm::dvec2 place(const TraceCrossing& crossing) const {
    const double in = value(crossing.in), out = value(crossing.out);
    const double way = out == belowAny ? 0.5 : std::clamp((in - level_) / (in - out), leastWay, 1 - leastWay);
    return glm::dvec2(crossing.in) + 0.5 + way * glm::dvec2(crossing.out - crossing.in);
  }

  // Returns whether two diagonal inside pixels of a cell are connected: the bilinear function reaches the
  // level at its saddle point.
  bool isJoined(double in, double otherIn, double out, double otherOut) const {
    if (out == belowAny || otherOut == belowAny) return false;
    return (in * otherIn - out * otherOut) / ((in + otherIn) - (out + otherOut)) >= level_;
  }

  TraceCrossing next(const TraceCrossing& crossing) const {
    const auto [in, out] = crossing;
    const glm::ivec2 along = quarterTurned(out - in);
    if (isIn(in + along)) {
      if (isIn(out + along)) return {out + along, out};
      return {in + along, out + along};
    }
    if (isIn(out + along) && isJoined(value(in), value(out + along), value(out), value(in + along)))
      return {out + along, out};
    return {in, in + along};
  }

  const SliceValues& slice_;
  const double level_;
};

std::optional<TraceCrossing> LevelLines::nearest(glm::dvec2 at) const {
  std::optional<TraceCrossing> found;
  double least = std::numeric_limits<double>::infinity();
  const int row = int(std::floor(at.y)), rows = std::max(row, slice_.size.y - row) + 1;
  const auto look = [&](glm::ivec2 pixel, glm::ivec2 other) {
    const bool isPixelIn = isIn(pixel);
    if (isPixelIn == isIn(other)) return;
    const TraceCrossing crossing = isPixelIn ? TraceCrossing{pixel, other} : TraceCrossing{other, pixel};
    if (const double distance = glm::distance(place(crossing), at); distance < least)
      least = distance, found = crossing;
  };
  // Searches outwards row by row while a nearer crossing is possible.
  for (int away = 0; away <= rows && away - 2 < least; ++away)
    for (const int y : {row - away, row + away}) {
      if (y < -1 || y >= slice_.size.y) continue;
      for (int x = -1; x < slice_.size.x; ++x) {
        look({x, y}, {x + 1, y});
        look({x, y}, {x, y + 1});
      }
    }
  return found;
}

std::vector<glm::dvec2> LevelLines::lineFrom(const TraceCrossing& first) const {
  std::vector<glm::dvec2> line;
  TraceCrossing at = first;
  do {
    line.push_back(place(at));
    at = next(at);
  } while (at != first);
  return line;
}

// Returns the interpolated value at a point, the pixel's own value beside pixels without one, or NaN if it
// has none.
double levelAt(const SliceValues& slice, glm::dvec2 at) {
  const glm::ivec2 last = slice.size - 1, pixel(glm::floor(at));
  const auto value = [&](glm::ivec2 p) {
    p = glm::clamp(p, glm::ivec2(0), last);
    return double(slice.values[std::size_t(p.y) * std::size_t(slice.size.x) + std::size_t(p.x)]);
  };
  if (at.x < 0 || at.y < 0 || pixel.x > last.x || pixel.y > last.y)
    return std::numeric_limits<double>::quiet_NaN();
  const glm::dvec2 low = glm::floor(at - 0.5), f = at - 0.5 - low;
  const glm::ivec2 p(low);
  const double above = value(p) + f.x * (value(p + glm::ivec2(1, 0)) - value(p));
  const double below =
      value(p + glm::ivec2(0, 1)) + f.x * (value(p + glm::ivec2(1, 1)) - value(p + glm::ivec2(0, 1)));
  const double between = above + f.y * (below - above);
  return std::isnan(between) ? value(pixel) : between;
}

}  // namespace

std::vector<glm::dvec2> levelTrace(const SliceValues& slice, glm::dvec2 at) {
  const double level = levelAt(slice, at);
  if (std::isnan(level)) return {};
  const LevelLines lines(slice, level);
  const auto first = lines.nearest(at);
  return first ? lines.lineFrom(*first) : std::vector<glm::dvec2>();
}

}  // namespace volumen
