#include <algorithm>
#include <array>
#include <numeric>

#include "viewer/segment/occupancy.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// The part of a line on which a value is at least 1/2 that goes evenly from one end to the other.
float partInside(float first, float last) {
  const float atFirst = first - 0.5f, atLast = last - 0.5f;
  if (atFirst >= 0 && atLast >= 0) return 1;
  if (atFirst < 0 && atLast < 0) return 0;
  return std::max(atFirst, atLast) / (std::max(atFirst, atLast) - std::min(atFirst, atLast));
}

// Of a cell with the values of four columns of two: (0, 0), (1, 0), (0, 1), (1, 1) in x and y.
float partInside(const std::array<std::array<float, 2>, 4>& columns) {
  constexpr int n = 5;
  float sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const float x = (float(i) + 0.5f) / n, y = (float(j) + 0.5f) / n;
      const auto at = [&](std::size_t end) {
        const float low = columns[0][end] + x * (columns[1][end] - columns[0][end]);
        const float high = columns[2][end] + x * (columns[3][end] - columns[2][end]);
        return low + y * (high - low);
      };
      sum += partInside(at(0), at(1));
    }
  return sum / float(n * n);
}

// Of the cells between rows j and j + 1 of slices k and k + 1, in cells; `least` and `most` have room for a
// row.
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
      cells += double(partInside({{{a[i], c[i]}, {a[i + 1], c[i + 1]}, {b[i], d[i]}, {b[i + 1], d[i + 1]}}}));
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
