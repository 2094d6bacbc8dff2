#include "viewer/segment/table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "viewer/segment/components.h"
#include "viewer/segment/range.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr double grownMm = 3;

// The axis of the grid that runs most along the patient.
int axisAlongPatient(const VoxelGeometry& geometry) {
  const glm::dmat3& step = geometry.patientFromVoxelStep;
  const glm::dvec3 spacing = geometry.spacing();
  int axis = 2;
  for (int a = 1; a >= 0; --a)
    if (std::abs(step[a].z) / spacing[a] > std::abs(step[axis].z) / spacing[axis]) axis = a;
  return axis;
}

// Labels what each slice across the axis encloses: what cannot be reached from the slice's rim.
void fillSlices(DenseLabels& map, int axis, const CancelToken& cancel) {
  const glm::ivec3 size = map.geometry.size;
  const glm::i64vec3 strides(1, size.x, std::int64_t(size.x) * size.y);
  const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
  const int width = size[a], height = size[b];
  parallelFor(size[axis], 0, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::uint8_t> reached;
    std::vector<std::pair<int, int>> open;
    for (std::int64_t slice = begin; slice < end && !cancel.cancelled(); ++slice) {
      std::uint8_t* const first = map.labels.data() + slice * strides[axis];
      const auto at = [&](int x, int y) -> std::uint8_t& { return first[x * strides[a] + y * strides[b]]; };
      reached.assign(std::size_t(width) * height, 0);
      const auto reach = [&](int x, int y) {
        if (x < 0 || y < 0 || x >= width || y >= height || at(x, y)) return;
        if (std::exchange(reached[std::size_t(y) * width + x], 1) == 0) open.emplace_back(x, y);
      };
      for (int x = 0; x < width; ++x) reach(x, 0), reach(x, height - 1);
      for (int y = 0; y < height; ++y) reach(0, y), reach(width - 1, y);
      while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        reach(x - 1, y), reach(x + 1, y), reach(x, y - 1), reach(x, y + 1);
      }
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) at(x, y) = !reached[std::size_t(y) * width + x];
    }
  });
}

// Labels all that lies within `reach` voxels of a label along one axis.
void growAlong(DenseLabels& map, int axis, int reach) {
  const glm::ivec3 size = map.geometry.size;
  const std::vector<std::uint8_t> before = map.labels;
  const std::int64_t row = axis == 0 ? 1 : axis == 1 ? size.x : std::int64_t(size.x) * size.y;
  parallelFor(map.geometry.voxelCount() / row, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n) {
      const int at = int(n % size[axis]);
      std::uint8_t* const to = map.labels.data() + n * row;
      for (int other = std::max(0, at - reach); other <= std::min(at + reach, size[axis] - 1); ++other) {
        const std::uint8_t* const from = before.data() + (n + other - at) * row;
        for (std::int64_t i = 0; i < row; ++i) to[i] |= from[i];
      }
    }
  });
}

}  // namespace

DenseLabels patientMask(const Volume& volume, const CancelToken& cancel) {
  DenseLabels map = largestComponent(labelRange(volume, {notAirHu, std::numeric_limits<double>::infinity()}));
  if (cancel.cancelled() || std::ranges::find(map.labels, 1) == map.labels.end()) return map;
  fillSlices(map, axisAlongPatient(map.geometry), cancel);
  const glm::dvec3 spacing = map.geometry.spacing();
  for (int axis = 0; axis < 3 && !cancel.cancelled(); ++axis)
    growAlong(map, axis, int(std::lround(grownMm / spacing[axis])));
  return map;
}

}  // namespace volumen
