#include "viewer/volume/bricks.h"

#include <algorithm>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Smallest and largest stored value of the voxels of block (a, b, c), its upper faces included.
template <class T>
void blockRange(const std::vector<T>& stored, glm::ivec3 size, glm::ivec3 block, T& low, T& high) {
  constexpr int edge = BrickRanges::edge;
  const glm::ivec3 first = block * edge;
  const glm::ivec3 last =
      glm::ivec3(std::min(first.x + edge, size.x - 1), std::min(first.y + edge, size.y - 1),
                 std::min(first.z + edge, size.z - 1));
  const T* start = stored.data() + (std::size_t(first.z) * size.y + first.y) * std::size_t(size.x) + first.x;
  low = high = *start;
  for (int k = first.z; k <= last.z; ++k)
    for (int j = first.y; j <= last.y; ++j) {
      const T* row = stored.data() + (std::size_t(k) * size.y + j) * std::size_t(size.x);
      for (int i = first.x; i <= last.x; ++i) low = std::min(low, row[i]), high = std::max(high, row[i]);
    }
}

}  // namespace

BrickRanges brickRanges(const Volume& volume) {
  const glm::ivec3 size = volume.size();
  BrickRanges bricks;
  bricks.count = (size + (BrickRanges::edge - 1)) / BrickRanges::edge;
  const std::size_t total = std::size_t(bricks.count.x) * bricks.count.y * bricks.count.z;
  bricks.low.resize(total);
  bricks.high.resize(total);
  std::visit(
      [&]<class T>(const std::vector<T>& stored) {
        parallelFor(std::int64_t(bricks.count.y) * bricks.count.z, 0,
                    [&](std::int64_t begin, std::int64_t end) {
                      for (std::int64_t row = begin; row < end; ++row)
                        for (int a = 0; a < bricks.count.x; ++a) {
                          T low, high;
                          blockRange(stored, size, {a, int(row % bricks.count.y), int(row / bricks.count.y)},
                                     low, high);
                          const float p = volume.realValue(low), q = volume.realValue(high);
                          const std::size_t n = std::size_t(row) * bricks.count.x + a;
                          bricks.low[n] = std::min(p, q);
                          bricks.high[n] = std::max(p, q);
                        }
                    });
      },
      volume.stored());
  return bricks;
}

}  // namespace volumen
