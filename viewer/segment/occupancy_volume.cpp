#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "viewer/segment/occupancy.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Returns the fraction of a line on which a value is at least 1/2 that runs linearly from `first` to `last`.
float partInside(float first, float last) {
  const float atFirst = first - 0.5f, atLast = last - 0.5f;
  if (atFirst >= 0 && atLast >= 0) return 1;
  if (atFirst < 0 && atLast < 0) return 0;
  return std::max(atFirst, atLast) / (std::max(atFirst, atLast) - std::min(atFirst, atLast));
}

using Corners = std::array<float, 8>;  // values at the corners of a cell, x fastest

// Returns the axis along which the values of a cell differ most.
std::size_t steepestAxis(const Corners& v) {
  std::array<float, 3> slope{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t c = 0; c < 8; ++c)
      if (!(c >> axis & 1)) slope[axis] += v[c | std::size_t(1) << axis] - v[c];
  const auto steeper = [&](std::size_t a, std::size_t b) { return std::abs(slope[b]) > std::abs(slope[a]); };
  const std::size_t first = steeper(0, 1) ? 1 : 0;
  return steeper(first, 2) ? 2 : first;
}

// Integrates along lines on the steepest axis, which cross a flat surface. Lines parallel to a surface along
// the grid would all have the same error.
float partInside(const Corners& v) {
  constexpr int n = 5;
  const std::size_t axis = steepestAxis(v), along = std::size_t(1) << axis;
  const std::size_t x = std::size_t(1) << (axis + 1) % 3, y = std::size_t(1) << (axis + 2) % 3;
  float sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const float atX = (float(i) + 0.5f) / n, atY = (float(j) + 0.5f) / n;
      const auto at = [&](std::size_t end) {
        const float low = v[end] + atX * (v[end | x] - v[end]);
        const float high = v[end | y] + atX * (v[end | x | y] - v[end | y]);
        return low + atY * (high - low);
      };
      sum += partInside(at(0), at(along));
    }
  return sum / float(n * n);
}

// Returns the inside volume of the cells between rows j and j + 1 of slices k and k + 1, in cells. `least`
// and `most` are buffers of one row.
double cellsInside(const OccupancyField& field, int j, int k, std::vector<float>& least,
                   std::vector<float>& most) {
  const auto width = std::size_t(field.size().x), height = std::size_t(field.size().y);
  const auto row = [&](int y, int z) {
    return field.values.data() + (std::size_t(z) * height + std::size_t(y)) * width;
  };
  const float *a = row(j, k), *b = row(j + 1, k), *c = row(j, k + 1), *d = row(j + 1, k + 1);
  for (std::size_t i = 0; i < width; ++i) {
    least[i] = std::min(std::min(a[i], b[i]), std::min(c[i], d[i]));
    most[i] = std::max(std::max(a[i], b[i]), std::max(c[i], d[i]));
  }
  double cells = 0;
  for (std::size_t i = 0; i + 1 < width; ++i) {
    if (std::max(most[i], most[i + 1]) < 0.5f) continue;
    if (std::min(least[i], least[i + 1]) >= 0.5f)
      cells += 1;
    else
      cells += double(partInside(Corners{a[i], a[i + 1], b[i], b[i + 1], c[i], c[i + 1], d[i], d[i + 1]}));
  }
  return cells;
}

}  // namespace

double volumeOf(const OccupancyField& field, const CancelToken& cancel) {
  if (field.values.empty()) return 0;
  const glm::ivec3 size = field.size();
  std::vector<double> slices(std::size_t(size.z));
  parallelFor(size.z - 1, 0, [&](std::int64_t begin, std::int64_t end) {
    std::vector<float> least(std::size_t(size.x)), most(std::size_t(size.x));
    for (int k = int(begin); k < int(end) && !cancel.cancelled(); ++k)
      for (int j = 0; j + 1 < size.y; ++j) slices[std::size_t(k)] += cellsInside(field, j, k, least, most);
  });
  return std::accumulate(slices.begin(), slices.end(), 0.0) * field.geometry.voxelVolume();
}

}  // namespace volumen
