#include "viewer/segment/spread.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "viewer/segment/bit_rows.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Widens a row: each bit spreads to the bits at offsets low to high, by doubling. Extra words on both sides
// hold bits that leave the row meanwhile.
class WideRow {
 public:
  WideRow(int words, int farthest)
      : count_(std::size_t(words)),
        beside_(std::size_t(2 * farthest) / 64 + 2),
        a_(count_ + 2 * beside_),
        b_(a_) {}

  bits::Row of(bits::Row row, int low, int high) {
    std::fill(a_.begin(), a_.end(), 0);
    std::ranges::copy(row, a_.begin() + std::ptrdiff_t(beside_));
    for (int width = 1, wanted = high - low + 1; width < wanted;) {
      const int by = std::min(width, wanted - width);
      move<true>(by);
      width += by;
    }
    move<false>(low);
    return {a_.data() + beside_, count_};
  }

 private:
  // Shifts all bits by `by`; with `keep`, the unshifted bits stay set too.
  template <bool keep>
  void move(int by) {
    const int words = by >> 6, up = by & 63;  // by = 64 words + up
    const std::uint64_t* const from = a_.data();
    std::uint64_t* const to = b_.data();
    const int all = int(a_.size());
    // Words of the row are at least two words from either end, so dropping the end words is safe.
    const int begin = std::max(0, words + 1), end = std::min(all, all + words);
    std::fill(to, to + begin, 0), std::fill(to + end, to + all, 0);
    if (up == 0)
      for (int n = begin; n < end; ++n) to[n] = from[n - words] | (keep ? from[n] : 0);
    else
      for (int n = begin; n < end; ++n)
        to[n] = from[n - words] << up | from[n - words - 1] >> (64 - up) | (keep ? from[n] : 0);
    a_.swap(b_);
  }

  std::size_t count_, beside_;
  std::vector<std::uint64_t> a_, b_;
};

// Rows of a structuring element with the same extent.
struct Width {
  int low, high;
  std::vector<std::pair<int, int>> steps;  // dj, dk
};

std::vector<Width> widthsOf(std::span<const SpreadRow> shape) {
  std::map<std::pair<int, int>, Width> widths;
  for (const SpreadRow& row : shape) {
    Width& width = widths.try_emplace({row.low, row.high}, Width{row.low, row.high, {}}).first->second;
    width.steps.emplace_back(row.dj, row.dk);
  }
  std::vector<Width> all;
  for (auto& [ends, width] : widths) all.push_back(std::move(width));
  return all;
}

bool isEmpty(bits::Row row) {
  std::uint64_t all = 0;
  for (const std::uint64_t word : row) all |= word;
  return all == 0;
}

}  // namespace

BitMask spread(const BitMask& mask, std::span<const SpreadRow> shape, const CancelToken& cancel) {
  const glm::ivec3 size = mask.size();
  BitMask made(mask.geometry());
  const std::vector<Width> widths = widthsOf(shape);
  int farthest = 0, slices = 0;
  for (const SpreadRow& row : shape) {
    farthest = std::max({farthest, std::abs(row.low), std::abs(row.high)});
    slices = std::max(slices, std::abs(row.dk));
  }
  // Computes the result of a slab row by row. Rows near two slabs are widened for both.
  const auto fillSlab = [&](int begin, int end) {
    WideRow wide(mask.wordsPerRow(), farthest);
    for (int k = std::max(0, begin - slices); k < std::min(size.z, end + slices) && !cancel.cancelled(); ++k)
      for (int j = 0; j < size.y; ++j) {
        const bits::Row row = mask.row(j, k);
        if (isEmpty(row)) continue;
        for (const Width& width : widths) {
          const bits::Row widened = wide.of(row, width.low, width.high);
          for (const auto& [dj, dk] : width.steps) {
            if (k + dk < begin || k + dk >= end || j + dj < 0 || j + dj >= size.y) continue;
            const auto to = made.row(j + dj, k + dk);
            for (std::size_t n = 0; n < to.size(); ++n) to[n] |= widened[n];
          }
        }
      }
    for (int k = begin; k < end; ++k)
      for (int j = 0; j < size.y; ++j) made.row(j, k).back() &= mask.lastWord();
  };
  const int slab = std::max({1, slices, size.z / (2 * allowedThreads())});
  parallelFor((size.z + slab - 1) / slab, 0, [&](std::int64_t begin, std::int64_t end) {
    for (int n = int(begin); n < int(end); ++n) fillSlab(n * slab, std::min((n + 1) * slab, size.z));
  });
  return made;
}

}  // namespace volumen
