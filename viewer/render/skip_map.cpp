#include "viewer/render/skip_map.h"

#include <algorithm>

namespace volumen {

namespace {

// One pass of the chessboard distance along an axis: a block is at most one farther than its neighbour before
// or behind. Chessboard distance separates into axes only when each pass takes the minimum over max(own
// offset, distance), so the pass looks at every block of the line within reach.
void spread(std::vector<std::uint8_t>& distance, std::size_t start, std::size_t stride, int length) {
  std::vector<std::uint8_t> line(length);
  for (int n = 0; n < length; ++n) line[n] = distance[start + n * stride];
  for (int n = 0; n < length; ++n) {
    int best = line[n];
    for (int away = 1; away < best; ++away) {
      if (n - away >= 0) best = std::min(best, std::max(away, int(line[n - away])));
      if (n + away < length) best = std::min(best, std::max(away, int(line[n + away])));
    }
    distance[start + n * stride] = std::uint8_t(best);
  }
}

}  // namespace

SkipMap makeSkipMap(glm::ivec3 count, const std::vector<std::uint8_t>& visible) {
  SkipMap map{count, std::vector<std::uint8_t>(visible.size() + 4, 255)};
  for (std::size_t n = 0; n < visible.size(); ++n)
    if (visible[n]) map.distance[n] = 0;
  const std::size_t strides[3] = {1, std::size_t(count.x), std::size_t(count.x) * count.y};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int b = 0; b < count[v]; ++b)
      for (int a = 0; a < count[u]; ++a)
        spread(map.distance, a * strides[u] + b * strides[v], strides[axis], count[axis]);
  }
  return map;
}

}  // namespace volumen
