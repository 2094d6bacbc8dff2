#include "viewer/segment/label_statistics.h"

#include <algorithm>
#include <cassert>
#include <glm/common.hpp>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

struct Sums {
  std::int64_t voxels = 0;
  double sum = 0, min = 0, max = 0;

  void add(double value) {
    min = voxels ? std::min(min, value) : value;
    max = voxels ? std::max(max, value) : value;
    sum += value;
    ++voxels;
  }
  void add(const Sums& other) {
    if (!other.voxels) return;
    min = voxels ? std::min(min, other.min) : other.min;
    max = voxels ? std::max(max, other.max) : other.max;
    sum += other.sum;
    voxels += other.voxels;
  }
};

}  // namespace

LabelStatistics labelStatistics(const LabelMap& map, const Volume& volume, std::uint8_t label) {
  assert(map.geometry() == volume.geometry());
  // Sums a slice, added in order: the same digits however the slices were shared out.
  const glm::ivec3 size = map.geometry().size;
  std::vector<Sums> slices(std::size_t(size.z));
  parallelFor(size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::uint8_t> row(std::size_t(size.x));
    for (std::int64_t k = begin; k < end; ++k)
      for (int j = 0; j < size.y; ++j) {
        map.readRow(j, int(k), row.data());
        const std::size_t first = (std::size_t(k) * size.y + j) * size.x;
        for (std::size_t i = 0; i < row.size(); ++i)
          if (row[i] == label) slices[std::size_t(k)].add(double(volume.valueAt(first + i)));
      }
  });
  Sums all;
  for (const Sums& s : slices) all.add(s);
  LabelStatistics out{all.voxels, {}, all.voxels ? all.sum / double(all.voxels) : 0, all.min, all.max};
  if (map.geometry().calibrated) out.millilitres = double(all.voxels) * map.geometry().voxelVolume() / 1000;
  return out;
}

std::array<std::int64_t, 256> labelCounts(const LabelMap& map) {
  std::array<std::int64_t, 256> counts{};
  const glm::ivec3 grid = map.geometry().size, bricks = map.bricks();
  for (int n = 0; n < bricks.x * bricks.y * bricks.z; ++n) {
    const glm::ivec3 at(n % bricks.x, n / bricks.x % bricks.y, n / bricks.x / bricks.y),
        size = glm::min(glm::ivec3(LabelMap::edge), grid - at * LabelMap::edge);
    const LabelMap::Brick& brick = map.brick(std::size_t(n));
    if (!brick.voxels) {
      counts[brick.label] += std::int64_t(size.x) * size.y * size.z;
      continue;
    }
    for (int k = 0; k < size.z; ++k)
      for (int j = 0; j < size.y; ++j) {
        const auto row = brick.voxels->begin() + (k * LabelMap::edge + j) * LabelMap::edge;
        std::for_each(row, row + size.x, [&](std::uint8_t label) { ++counts[label]; });
      }
  }
  return counts;
}

std::optional<VoxelBox> labelBox(const LabelMap& map, std::uint8_t label) {
  const glm::ivec3 size = map.geometry().size;
  std::optional<VoxelBox> box;
  std::vector<std::uint8_t> row(std::size_t(size.x));
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      map.readRow(j, k, row.data());
      const auto first = std::ranges::find(row, label);
      if (first == row.end()) continue;
      int last = size.x - 1;
      while (row[std::size_t(last)] != label) --last;
      const VoxelBox here{{int(first - row.begin()), j, k}, {last, j, k}};
      if (!box) box = here;
      box->low = glm::min(box->low, here.low);
      box->high = glm::max(box->high, here.high);
    }
  return box;
}

}  // namespace volumen
