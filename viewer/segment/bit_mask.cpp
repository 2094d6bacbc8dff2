#include "viewer/segment/bit_mask.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <cstring>
#include <glm/common.hpp>
#include <mutex>

#include "viewer/segment/bit_rows.h"
#include "viewer/volume/buffer.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

template <class Combine>
BitMask combined(BitMask a, const BitMask& b, const Combine& combine) {
  assert(a.size() == b.size());
  const auto to = a.words();
  const auto from = b.words();
  parallelFor(std::int64_t(to.size()), 0, [&](std::int64_t begin, std::int64_t end) {
    for (auto n = std::size_t(begin); n < std::size_t(end); ++n) to[n] = combine(to[n], from[n]);
  });
  return a;
}

// Returns a bit for each of 32 bytes: set if it equals `label`.
std::uint32_t bitsEqual(const std::uint8_t* bytes, std::uint8_t label) {
  std::array<std::uint8_t, 32> same;
  for (std::size_t n = 0; n < same.size(); ++n) same[n] = bytes[n] == label;
  std::uint32_t all = 0;
  for (std::size_t n = 0; n < same.size(); n += 8) {
    std::uint64_t eight;
    std::memcpy(&eight, same.data() + n, 8);
    all |= std::uint32_t(bits::bitsOfBytes(eight)) << n;
  }
  return all;
}

constexpr int brickRow = LabelMap::edge;  // voxels
static_assert(brickRow == 32, "half a word of a mask");

std::size_t firstInBrick(int j, int k) { return std::size_t(brickRow * (j + brickRow * k)); }

// Maps old labels to new ones, outside [0] and inside [1] the mask.
using NewLabels = std::array<std::array<std::uint8_t, 256>, 2>;

NewLabels newLabels(std::uint8_t label, std::span<const std::uint8_t> locked) {
  NewLabels to;
  for (int from = 0; from < 256; ++from) {
    const bool stays = std::ranges::find(locked, from) != locked.end();
    to[0][std::size_t(from)] = std::uint8_t(from == label && !stays ? 0 : from);
    to[1][std::size_t(from)] = stays ? std::uint8_t(from) : label;
  }
  return to;
}

// Returns the mask bits of the 32 voxels from (i, j, k) on; i must be a multiple of 32.
std::uint32_t bitsFrom(const BitMask& mask, glm::ivec3 voxel) {
  return std::uint32_t(mask.row(voxel.y, voxel.z)[std::size_t(voxel.x) / 64] >> voxel.x % 64);
}

// Returns the voxels of a brick row with `label`, restricted to the bits of `whole`.
std::uint32_t labelled(const LabelMap::Brick& brick, std::size_t first, std::uint8_t label,
                       std::uint32_t whole) {
  if (!brick.voxels) return brick.label == label ? whole : 0;
  return bitsEqual(brick.voxels->data() + first, label) & whole;
}

LabelMap::Brick relabelled(const LabelMap::Brick& brick, glm::ivec3 corner, glm::ivec3 size,
                           const BitMask& mask, std::uint8_t label, const NewLabels& to) {
  const std::uint32_t whole = ~std::uint32_t(0) >> (32 - size.x);
  bool none = true, all = true, same = true;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      const std::uint32_t in = bitsFrom(mask, corner + glm::ivec3(0, j, k));
      none = none && !in;
      all = all && in == whole;
      same = same && in == labelled(brick, firstInBrick(j, k), label, whole);
    }
  if (same) return brick;
  if (!brick.voxels && (none || all)) return {to[all][brick.label], nullptr};
  auto voxels = std::make_shared<LabelMap::Voxels>();
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      const std::uint32_t in = bitsFrom(mask, corner + glm::ivec3(0, j, k));
      const std::size_t first = firstInBrick(j, k);
      const std::uint8_t* const from = brick.voxels ? brick.voxels->data() + first : nullptr;
      std::uint8_t* const now = voxels->data() + first;
      for (int i = 0; i < size.x; ++i) now[i] = to[in >> i & 1][from ? from[i] : brick.label];
    }
  const LabelMap::Brick made = LabelMap::Brick::of(std::move(voxels), size);
  return made == brick ? brick : made;
}

}  // namespace

BitMask::BitMask(const VoxelGeometry& geometry)
    : geometry_(geometry),
      wordsPerRow_((geometry.size.x + 63) / 64),
      words_(zeros<std::uint64_t>(std::size_t(wordsPerRow_) * std::size_t(geometry.size.y) *
                                  std::size_t(geometry.size.z))) {}

void BitMask::set(glm::ivec3 voxel, bool in) {
  std::uint64_t& word = words_[firstOf(voxel.y, voxel.z) + std::size_t(voxel.x) / 64];
  const std::uint64_t bit = std::uint64_t(1) << voxel.x % 64;
  word = in ? word | bit : word & ~bit;
}

std::int64_t BitMask::count() const {
  std::atomic<std::int64_t> all = 0;
  parallelFor(std::int64_t(words_.size()), 0, [&](std::int64_t begin, std::int64_t end) {
    std::int64_t here = 0;
    for (auto n = std::size_t(begin); n < std::size_t(end); ++n) here += std::popcount(words_[n]);
    all += here;
  });
  return all;
}

bool BitMask::empty() const {
  return std::ranges::all_of(words_, [](std::uint64_t word) { return word == 0; });
}

std::optional<VoxelBox> BitMask::box() const {
  std::optional<VoxelBox> box;
  std::mutex mutex;
  parallelFor(geometry_.size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    std::optional<VoxelBox> here;
    for (int k = int(begin); k < int(end); ++k)
      for (int j = 0; j < geometry_.size.y; ++j) {
        const auto words = row(j, k);
        const int first = bits::firstSet(words, 0, geometry_.size.x);
        if (first == geometry_.size.x) continue;
        int word = wordsPerRow_ - 1;
        while (!words[std::size_t(word)]) --word;
        const int last = word * 64 + 63 - std::countl_zero(words[std::size_t(word)]);
        if (!here) here = {{first, j, k}, {last, j, k}};
        here->low = glm::min(here->low, glm::ivec3(first, j, k));
        here->high = glm::max(here->high, glm::ivec3(last, j, k));
      }
    if (!here) return;
    const std::lock_guard lock(mutex);
    if (!box) box = here;
    box->low = glm::min(box->low, here->low);
    box->high = glm::max(box->high, here->high);
  });
  return box;
}

BitMask united(BitMask a, const BitMask& b) {
  return combined(std::move(a), b, [](std::uint64_t x, std::uint64_t y) { return x | y; });
}

BitMask intersected(BitMask a, const BitMask& b) {
  return combined(std::move(a), b, [](std::uint64_t x, std::uint64_t y) { return x & y; });
}

BitMask subtracted(BitMask a, const BitMask& b) {
  return combined(std::move(a), b, [](std::uint64_t x, std::uint64_t y) { return x & ~y; });
}

BitMask inverted(BitMask mask) {
  const glm::ivec3 size = mask.size();
  parallelFor(std::int64_t(size.y) * size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n) {
      const auto row = mask.row(int(n % size.y), int(n / size.y));
      for (std::uint64_t& word : row) word = ~word;
      row.back() &= mask.lastWord();
    }
  });
  return mask;
}

BitMask maskOf(const LabelMap& map, std::uint8_t label) {
  BitMask mask(map.geometry());
  const glm::ivec3 size = mask.size(), bricks = map.bricks();
  parallelFor(std::int64_t(size.y) * size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n) {
      const int j = int(n % size.y), k = int(n / size.y);
      const auto row = mask.row(j, k);
      const int brick = bricks.x * (j / brickRow + bricks.y * (k / brickRow));
      for (int b = 0; b < bricks.x; ++b) {
        const std::uint64_t in = labelled(map.brick(std::size_t(brick + b)),
                                          firstInBrick(j % brickRow, k % brickRow), label, ~std::uint32_t(0));
        row[std::size_t(b) / 2] |= in << b % 2 * 32;
      }
      row.back() &= mask.lastWord();
    }
  });
  return mask;
}

LabelMap withLabel(const LabelMap& map, std::uint8_t label, const BitMask& mask,
                   std::span<const std::uint8_t> locked) {
  assert(map.geometry().size == mask.size());
  const NewLabels to = newLabels(label, locked);
  LabelMap made = map;
  const glm::ivec3 bricks = map.bricks();
  parallelFor(std::int64_t(made.held_.size()), 0, [&](std::int64_t begin, std::int64_t end) {
    for (auto n = int(begin); n < int(end); ++n) {
      const glm::ivec3 corner =
          brickRow * glm::ivec3(n % bricks.x, n / bricks.x % bricks.y, n / bricks.x / bricks.y);
      LabelMap::Brick& brick = made.held_[std::size_t(n)];
      brick = relabelled(brick, corner, made.sizeOf(std::size_t(n)), mask, label, to);
    }
  });
  return made;
}

}  // namespace volumen
