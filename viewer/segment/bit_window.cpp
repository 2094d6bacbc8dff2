#include "viewer/segment/bit_window.h"

#include <algorithm>
#include <glm/common.hpp>

namespace volumen {

namespace {

constexpr std::uint64_t allBits = ~std::uint64_t(0);

// Returns a word with the lowest `count` bits set.
std::uint64_t lowest(int count) { return count >= 64 ? allBits : (std::uint64_t(1) << count) - 1; }

// Returns the bits of voxels from .. from + 63 of a row of `size` voxels.
std::uint64_t bitsFrom(std::span<const std::uint64_t> row, int size, int from, BeyondGrid beyond) {
  const int word = from >> 6, shift = from & 63;
  const auto wordAt = [&](int n) { return n >= 0 && n < int(row.size()) ? row[std::size_t(n)] : 0; };
  std::uint64_t bits = wordAt(word) >> shift;
  if (shift) bits |= wordAt(word + 1) << (64 - shift);
  if (beyond == BeyondGrid::nothing) return bits;
  if (from < 0 && (row[0] & 1)) bits |= lowest(-from);
  const int last = size - 1;
  if (from + 63 > last && (row[std::size_t(last) / 64] >> last % 64 & 1))
    bits |= ~lowest(std::max(0, size - from));
  return bits;
}

}  // namespace

void BitWindow::start(const VoxelBox& box) {
  size_ = box.high - box.low + 1;
  wordsPerRow_ = std::size_t(size_.x + 63) / 64;
  words_.resize(wordsPerRow_ * std::size_t(size_.y) * std::size_t(size_.z));
  any_ = false;
  all_ = true;
}

// Clears the bits after the last voxel of a row and updates any_ and all_.
void BitWindow::take(std::uint64_t* words) {
  const std::size_t last = wordsPerRow_ - 1;
  const std::uint64_t inLast = lowest(size_.x - 64 * int(last));
  words[last] &= inLast;
  for (std::size_t n = 0; n <= last; ++n) {
    any_ = any_ || words[n];
    all_ = all_ && words[n] == (n == last ? inLast : allBits);
  }
}

void BitWindow::read(const BitMask& mask, const VoxelBox& box, BeyondGrid beyond) {
  start(box);
  const glm::ivec3 last = mask.size() - 1;
  std::uint64_t* words = words_.data();
  for (int k = box.low.z; k <= box.high.z; ++k)
    for (int j = box.low.y; j <= box.high.y; ++j, words += wordsPerRow_) {
      const int nearJ = std::clamp(j, 0, last.y), nearK = std::clamp(k, 0, last.z);
      const bool nothing = beyond == BeyondGrid::nothing && (nearJ != j || nearK != k);
      for (int n = 0; n < int(wordsPerRow_); ++n)
        words[n] = nothing ? 0 : bitsFrom(mask.row(nearJ, nearK), last.x + 1, box.low.x + 64 * n, beyond);
      take(words);
    }
}

void BitWindow::read(std::span<const std::uint8_t> labels, std::uint8_t label, const VoxelBox& box) {
  start(box);
  const std::uint8_t* from = labels.data();
  std::uint64_t* words = words_.data();
  for (int row = 0; row < size_.y * size_.z; ++row, words += wordsPerRow_, from += size_.x) {
    std::fill_n(words, wordsPerRow_, 0);
    for (int i = 0; i < size_.x; ++i) words[i / 64] |= std::uint64_t(from[i] == label) << i % 64;
    take(words);
  }
}

}  // namespace volumen
