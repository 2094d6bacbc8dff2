#include "viewer/volume/bricks.h"

#include <algorithm>
#include <limits>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Smallest and largest value of one line of blocks (b, c), their upper faces included: first across the rows
// of the line, voxel by voxel, then along x.
template <class T>
void lineRange(const std::vector<T>& stored, glm::ivec3 size, int b, int c, std::vector<T>& lowest,
               std::vector<T>& highest) {
  constexpr int edge = BrickRanges::edge;
  lowest.assign(size.x, std::numeric_limits<T>::max());
  highest.assign(size.x, std::numeric_limits<T>::lowest());
  T *low = lowest.data(), *high = highest.data();
  for (int k = c * edge; k <= std::min(c * edge + edge, size.z - 1); ++k)
    for (int j = b * edge; j <= std::min(b * edge + edge, size.y - 1); ++j) {
      const T* row = stored.data() + (std::size_t(k) * size.y + j) * std::size_t(size.x);
      for (int i = 0; i < size.x; ++i) {
        low[i] = std::min(low[i], row[i]);
        high[i] = std::max(high[i], row[i]);
      }
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
        parallelFor(
            std::int64_t(bricks.count.y) * bricks.count.z, 0, [&](std::int64_t begin, std::int64_t end) {
              std::vector<T> low, high;
              for (std::int64_t line = begin; line < end; ++line) {
                lineRange(stored, size, int(line % bricks.count.y), int(line / bricks.count.y), low, high);
                for (int a = 0; a < bricks.count.x; ++a) {
                  const int first = a * BrickRanges::edge;
                  const int last = std::min(first + BrickRanges::edge, size.x - 1);
                  const float p = volume.realValue(*std::min_element(&low[first], &low[last] + 1));
                  const float q = volume.realValue(*std::max_element(&high[first], &high[last] + 1));
                  const std::size_t n = std::size_t(line) * bricks.count.x + a;
                  bricks.low[n] = std::min(p, q);
                  bricks.high[n] = std::max(p, q);
                }
              }
            });
      },
      volume.stored());
  return bricks;
}

}  // namespace volumen
