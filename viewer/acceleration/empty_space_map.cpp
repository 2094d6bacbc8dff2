#include "viewer/acceleration/empty_space_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Sets `bits` of to[n] wherever visible[n] is not 0.
void setWhere(const std::uint8_t* visible, std::size_t count, std::uint8_t bits, std::uint8_t* to) {
  for (std::size_t n = 0; n < count; ++n) to[n] |= visible[n] ? bits : std::uint8_t(0);
}

// Computes to[n] |= from[n] & bits for all n. The two arrays do not overlap.
void takeIn(const std::uint8_t* from, std::size_t count, std::uint8_t bits, std::uint8_t* to) {
  for (std::size_t n = 0; n < count; ++n) to[n] |= std::uint8_t(from[n] & bits);
}

// Adds to every entry of a slice the bits `ofRows` of the next rows and `ofColumns` of the next columns.
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

// Sets bit n % 8 of to[n / 8] for each of `count` entries of 0 or 255. 8 more entries must be readable.
void pack(const std::uint8_t* entries, int count, std::uint8_t* to) {
  for (int first = 0; first < count; first += 8) {
    std::uint64_t eight;
    std::memcpy(&eight, entries + first, 8);
    const auto bits = std::uint8_t((eight & 0x0101010101010101u) * 0x0102040810204080u >> 56);
    to[first / 8] = std::uint8_t(bits & (count - first < 8 ? (1 << (count - first)) - 1 : 255));
  }
}

}  // namespace

EmptySpaceMap makeEmptySpaceMap(int edge, glm::ivec3 count, const std::vector<std::uint8_t>& visible,
                                int reach, EmptySpaceMap memory) {
  constexpr std::uint8_t all = 0xff, alongX = 0xaa, alongY = 0xcc, alongZ = 0xf0;
  EmptySpaceMap map = std::move(memory);
  map.shift = std::countr_zero(unsigned(edge));
  map.count = count;
  map.reach = reach;
  const std::size_t slice = std::size_t(count.x) * count.y;
  map.near.resize(map.layerAt(map.layers()) + 4);
  const auto makeSlice = [&](std::int64_t k, int farther, auto bitsAlong, std::uint8_t* to) {
    std::fill_n(to, slice, std::uint8_t(0));
    setWhere(visible.data() + k * slice, slice, all, to);
    for (std::int64_t next = k + 1; next <= std::min<std::int64_t>(k + farther, count.z - 1); ++next)
      setWhere(visible.data() + next * slice, slice, bitsAlong[2], to);
    takeInAlongSlice(to, count, farther, bitsAlong[1], bitsAlong[0]);
  };
  parallelFor(count.z, 0, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::uint8_t> part(slice + 8);
    for (std::int64_t k = begin; k < end; ++k)
      for (int layer = 0; layer < map.layers(); ++layer) {
        if (layer == 0)
          makeSlice(k, 1, std::array{alongX, alongY, alongZ}, part.data());
        else
          makeSlice(k, reach - (map.layers() - 1 - layer), std::array{all, all, all}, part.data());
        const int rowBytes = layer == 0 ? map.rowBlocks() : map.rowBlocks() / 8;
        for (int j = 0; j < count.y; ++j) {
          const std::uint8_t* row = part.data() + std::size_t(j) * count.x;
          std::uint8_t* to = map.near.data() + map.layerAt(layer) + (k * count.y + j) * rowBytes;
          if (layer == 0)
            std::copy_n(row, count.x, to);
          else
            pack(row, count.x, to);
        }
      }
  });
  return map;
}

}  // namespace volumen
