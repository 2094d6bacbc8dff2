#include "io/dicom/shutter.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace volumen::dicom {
namespace {

constexpr std::uint32_t frameShutter = 0x00189472;
constexpr std::size_t mostCorners = 4096;

/// Columns of one row that a shape leaves free, from (inclusive) and to (exclusive), counted from 0.
struct Run {
  double from = 0, to = 0;
};

/// A shape of a shutter: what it leaves free of a row (from 0), in order.
using Shape = std::function<std::vector<Run>(int)>;

Result<Shape> rectangle(const DataSet& data, DataSet::Scope scope) {
  const auto left = data.number(0x00181602, scope), right = data.number(0x00181604, scope);
  const auto top = data.number(0x00181606, scope), bottom = data.number(0x00181608, scope);
  if (!left || !right || !top || !bottom) return Error{"an edge of its rectangle is missing"};
  return Shape([=](int row) {
    if (row + 1 < *top || row + 1 > *bottom) return std::vector<Run>{};
    return std::vector<Run>{{*left - 1, *right}};
  });
}

/// The radius counts pixels along a row.
Result<Shape> circle(const DataSet& data, DataSet::Scope scope, glm::dvec2 pixelMm) {
  const auto centre = data.numbers(0x00181610, scope);
  const auto radius = data.number(0x00181612, scope);
  if (!centre || centre->size() != 2 || !radius || !(*radius > 0))
    return Error{"the centre or radius of its circle is missing"};
  const double row0 = (*centre)[0] - 1, column0 = (*centre)[1] - 1, r = *radius;
  const double aspect = pixelMm.y / pixelMm.x;
  return Shape([=](int row) {
    const double dy = (row - row0) * aspect, half = std::sqrt(r * r - dy * dy);
    if (!(half >= 0)) return std::vector<Run>{};
    return std::vector<Run>{{std::ceil(column0 - half), std::floor(column0 + half) + 1}};
  });
}

/// Pixels whose centre lies inside, even-odd, or on an edge.
Result<Shape> polygon(const DataSet& data, DataSet::Scope scope) {
  const auto numbers = data.numbers(0x00181620, scope);
  if (!numbers || numbers->size() < 6 || numbers->size() % 2 == 1)
    return Error{"the corners of its polygon are missing or incomplete"};
  if (numbers->size() > 2 * mostCorners) return Error{"its polygon has more than 4096 corners"};
  std::vector<glm::dvec2> corners;
  for (std::size_t n = 0; n < numbers->size(); n += 2)
    corners.emplace_back((*numbers)[n + 1] - 1, (*numbers)[n] - 1);
  return Shape([=](int row) {
    std::vector<double> crossings;
    std::vector<Run> runs;
    for (std::size_t n = 0; n < corners.size(); ++n) {
      const glm::dvec2 a = corners[n], b = corners[(n + 1) % corners.size()];
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
  });
}

/// Hides what the shape does not leave free.
void hideOutside(const Shape& shape, glm::ivec2 size, std::vector<std::uint8_t>& hidden) {
  const auto column = [&](double x) { return std::ptrdiff_t(std::clamp(x, 0.0, double(size.x))); };
  for (int row = 0; row < size.y; ++row) {
    const auto begin = hidden.begin() + std::ptrdiff_t(row) * size.x;
    std::ptrdiff_t free = 0;
    for (const Run& run : shape(row)) {
      if (column(run.from) > free) std::fill(begin + free, begin + column(run.from), std::uint8_t(1));
      free = std::max(free, column(run.to));
    }
    std::fill(begin + free, begin + size.x, std::uint8_t(1));
  }
}

}  // namespace

std::vector<std::uint8_t> readShutter(const DataSet& data, const FrameScopes& at, glm::ivec2 size,
                                      glm::dvec2 pixelMm, std::vector<std::string>& warnings) {
  const DataSet::Scope ofFrame = at.of(frameShutter);
  const DataSet::Scope scope = data.has(0x00181600, ofFrame) ? ofFrame : data.root();
  std::vector<std::uint8_t> hidden(std::size_t(size.x) * std::size_t(size.y));
  for (const std::string& name : data.values(0x00181600, scope)) {
    const Result<Shape> shape = name == "RECTANGULAR" ? rectangle(data, scope)
                                : name == "CIRCULAR"  ? circle(data, scope, pixelMm)
                                : name == "POLYGONAL" ? polygon(data, scope)
                                                      : Error{"its shape is " + toUtf8(name, {})};
    if (shape)
      hideOutside(*shape, size, hidden);
    else
      warnings.push_back("A shutter is left out: " + shape.message() + ".");
  }
  const bool hides = std::find(hidden.begin(), hidden.end(), 1) != hidden.end();
  return hides ? hidden : std::vector<std::uint8_t>{};
}

}  // namespace volumen::dicom
