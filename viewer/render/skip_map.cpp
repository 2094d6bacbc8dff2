#include "viewer/render/skip_map.h"

#include <algorithm>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// to[n] |= from[n] for all n; the two do not overlap.
void takeIn(const std::uint8_t* from, std::size_t count, std::uint8_t* to) {
  for (std::size_t n = 0; n < count; ++n) to[n] |= from[n];
}

// Every entry of a slice takes in those of the next `reach` rows and columns.
void takeInAlongSlice(std::uint8_t* slice, glm::ivec3 count, int reach) {
  const std::size_t row = count.x;
  std::uint8_t* last = slice + row * (std::size_t(count.y) - 1);
  for (int n = 0; n < reach; ++n)
    for (std::uint8_t* r = slice; r != last; r += row) takeIn(r + row, row, r);
  for (int n = 0; n < reach; ++n)
    for (std::uint8_t* r = slice; r <= last; r += row)
      for (std::size_t i = 0; i + 1 < row; ++i) r[i] |= r[i + 1];
}

}  // namespace

SkipMap makeSkipMap(glm::ivec3 count, const std::vector<std::uint8_t>& visible, int reach, SkipMap memory) {
  SkipMap map = std::move(memory);
  map.count = count;
  map.reach = reach;
  const std::size_t total = visible.size(), slice = std::size_t(count.x) * count.y;
  map.near.resize(2 * total + 4);
  parallelFor(count.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k) {
      const std::uint8_t* from = visible.data() + k * slice;
      std::uint8_t *tight = map.near.data() + k * slice, *wide = tight + total;
      std::copy_n(from, slice, tight);
      const std::int64_t next = std::min<std::int64_t>(reach, count.z - 1 - k);
      for (std::int64_t n = 1; n < std::min<std::int64_t>(reach, next + 1); ++n)
        takeIn(from + n * slice, slice, tight);
      std::copy_n(tight, slice, wide);
      if (next == reach) takeIn(from + next * slice, slice, wide);
      takeInAlongSlice(tight, count, reach - 1);
      takeInAlongSlice(wide, count, reach);
    }
  });
  return map;
}

}  // namespace volumen
