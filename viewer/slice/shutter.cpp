#include "viewer/slice/shutter.h"

#include <algorithm>
#include <cmath>

namespace volumen {
namespace {

/// Visible columns [from, to) of one row, counted from 0.
struct Run {
  double from = 0, to = 0;
};

std::vector<Run> rectangleRuns(const ShutterShape& shape, int row) {
  if (row + 1 < shape.from.y || row + 1 > shape.to.y) return {};
  return {{shape.from.x - 1, shape.to.x}};
}

std::vector<Run> circleRuns(const ShutterShape& shape, int row, double aspect) {
  const double r = shape.radius, dy = (row + 1 - shape.centre.y) * aspect, half = std::sqrt(r * r - dy * dy);
  if (!(half >= 0)) return {};
  const double column = shape.centre.x - 1;
  return {{std::ceil(column - half), std::floor(column + half) + 1}};
}

/// Uses the even-odd rule; edges along the row are visible.
std::vector<Run> polygonRuns(const ShutterShape& shape, int row) {
  std::vector<double> crossings;
  std::vector<Run> runs;
  for (std::size_t n = 0; n < shape.corners.size(); ++n) {
    const glm::dvec2 a = shape.corners[n] - 1.0, b = shape.corners[(n + 1) % shape.corners.size()] - 1.0;
    if (a.y == row) {
      const double other = b.y == row ? b.x : a.x;
      runs.push_back({std::ceil(std::min(a.x, other)), std::floor(std::max(a.x, other)) + 1});
    }
    if ((a.y <= row) != (b.y <= row)) crossings.push_back(a.x + (row - a.y) / (b.y - a.y) * (b.x - a.x));
  }
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t n = 0; n + 1 < crossings.size(); n += 2)
    runs.push_back({std::ceil(crossings[n]), std::floor(crossings[n + 1]) + 1});
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.from < b.from; });
  return runs;
}

/// Returns the visible columns of a row (from 0), in order.
std::vector<Run> freeRuns(const ShutterShape& shape, int row, double aspect) {
  switch (shape.kind) {
    case ShutterShape::Kind::rectangle:
      return rectangleRuns(shape, row);
    case ShutterShape::Kind::circle:
      return circleRuns(shape, row, aspect);
    case ShutterShape::Kind::polygon:
      return polygonRuns(shape, row);
  }
  return {};
}

}  // namespace

std::vector<std::uint8_t> hiddenBy(const Shutter& shutter, glm::ivec2 size, glm::dvec2 pixelMm) {
  std::vector<std::uint8_t> hidden(std::size_t(size.x) * std::size_t(size.y));
  const auto column = [&](double x) { return std::ptrdiff_t(std::clamp(x, 0.0, double(size.x))); };
  for (const ShutterShape& shape : shutter.shapes)
    for (int row = 0; row < size.y; ++row) {
      const auto begin = hidden.begin() + std::ptrdiff_t(row) * size.x;
      std::ptrdiff_t free = 0;
      for (const Run& run : freeRuns(shape, row, pixelMm.y / pixelMm.x)) {
        if (column(run.from) > free) std::fill(begin + free, begin + column(run.from), std::uint8_t(1));
        free = std::max(free, column(run.to));
      }
      std::fill(begin + free, begin + size.x, std::uint8_t(1));
    }
  const bool hides = std::find(hidden.begin(), hidden.end(), 1) != hidden.end();
  return hides ? hidden : std::vector<std::uint8_t>{};
}

}  // namespace volumen
