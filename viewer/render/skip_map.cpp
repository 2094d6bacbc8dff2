#include "viewer/render/skip_map.h"

#include <algorithm>
#include <array>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Sets these bits of to[n] wherever visible[n] is not 0.
void setWhere(const std::uint8_t* visible, std::size_t count, std::uint8_t bits, std::uint8_t* to) {
  for (std::size_t n = 0; n < count; ++n) to[n] |= visible[n] ? bits : std::uint8_t(0);
}

// to[n] |= from[n] & bits for all n; the two do not overlap.
void takeIn(const std::uint8_t* from, std::size_t count, std::uint8_t bits, std::uint8_t* to) {
  for (std::size_t n = 0; n < count; ++n) to[n] |= std::uint8_t(from[n] & bits);
}

// Every entry of a slice takes in, of those named bits, those of the next rows and columns.
void takeInAlongSlice(std::uint8_t* slice, glm::ivec3 count, int reach, std::uint8_t ofRows,
                      std::uint8_t ofColumns) {
  const std::size_t row = count.x;
  std::uint8_t* last = slice + row * (std::size_t(count.y) - 1);
  for (int n = 0; n < reach; ++n)
    for (std::uint8_t* r = slice; r != last; r += row) takeIn(r + row, row, ofRows, r);
  for (int n = 0; n < reach; ++n)
    for (std::uint8_t* r = slice; r <= last; r += row)
      for (std::size_t i = 0; i + 1 < row; ++i) r[i] |= std::uint8_t(r[i + 1] & ofColumns);
}

}  // namespace

SkipMap makeSkipMap(glm::ivec3 count, const std::vector<std::uint8_t>& visible, int reach, SkipMap memory) {
  constexpr std::uint8_t all = 0xff, alongX = 0xaa, alongY = 0xcc, alongZ = 0xf0;
  SkipMap map = std::move(memory);
  map.count = count;
  map.reach = reach;
  const std::size_t total = visible.size(), slice = std::size_t(count.x) * count.y;
  map.near.resize(map.layers() * total + 4);
  const auto makeSlice = [&](std::int64_t k, int layer, int farther, auto bitsAlong) {
    std::uint8_t* to = map.near.data() + layer * total + k * slice;
    std::fill_n(to, slice, std::uint8_t(0));
    setWhere(visible.data() + k * slice, slice, all, to);
    for (std::int64_t next = k + 1; next <= std::min<std::int64_t>(k + farther, count.z - 1); ++next)
      setWhere(visible.data() + next * slice, slice, bitsAlong[2], to);
    takeInAlongSlice(to, count, farther, bitsAlong[1], bitsAlong[0]);
  };
  parallelFor(count.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k) {
      makeSlice(k, 0, 1, std::array{alongX, alongY, alongZ});
      for (int layer = 1; layer < map.layers(); ++layer)
        makeSlice(k, layer, reach - (map.layers() - 1 - layer), std::array{all, all, all});
    }
  });
  return map;
}

}  // namespace volumen
