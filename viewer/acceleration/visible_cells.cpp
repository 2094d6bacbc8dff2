#include "viewer/acceleration/visible_cells.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr int edge = VisibleCells::edge;

// Returns bits: bit n is set if byte n of the up to 8 bytes at `bytes` is not 0.
std::uint64_t bitsOf(const std::uint8_t* bytes, int count = 8) {
  std::uint64_t eight = 0;
  std::memcpy(&eight, bytes, count);
  eight |= eight >> 4;
  eight |= eight >> 2;
  eight |= eight >> 1;
  return (eight & 0x0101010101010101u) * 0x0102040810204080u >> 56;
}

// A word has the states of 32 blocks that adjoin along i. For the n-th, bit n is set until it is examined,
// and bit 32 + n while a thread examines it.
constexpr int statesAWord = 32;

// Calls row(first block, last block's index along i) for each row of blocks that hold positions from `low` to
// `high`. Blocks are clamped to a grid of `count`.
template <class Row>
void forRows(glm::ivec3 count, glm::vec3 low, glm::vec3 high, const Row& row) {
  const auto blockOf = [&](glm::vec3 p) {
    return glm::clamp(glm::ivec3(p) / edge, glm::ivec3(0), count - 1);
  };
  const glm::ivec3 first = blockOf(low), last = blockOf(high);
  for (int c = first.z; c <= last.z; ++c)
    for (int b = first.y; b <= last.y; ++b) row(glm::ivec3(first.x, b, c), last.x);
}

}  // namespace

struct VisibleCells::RowRange {
  Row low, high;
};

void VisibleCells::takeIn(const RowRange& from, RowRange& to) {
  for (std::size_t n = 0; n < from.low.size(); ++n) {
    to.low[n] = std::min(to.low[n], from.low[n]);
    to.high[n] = std::max(to.high[n], from.high[n]);
  }
}

std::vector<VisibleCells::Span> VisibleCells::spansOf(const CurveTable& curve) {
  std::vector<Span> spans;
  const auto limited = [](double d) { return std::int16_t(std::clamp(d, -32768.0, 32767.0)); };
  for (int s = 0; s < curve.segments; ++s) {
    const bool atStart = curve.opacity[s] > 0;
    if (!atStart && curve.opacityRise[s] <= 0) continue;
    const double start = s == 0 ? -32768 : curve.start[s];
    const double low = atStart ? std::ceil(start) : std::floor(start) + 1;
    const double high = std::ceil(double(curve.node[s])) - 1;
    if (low > 32767 || high < -32768) continue;
    if (!spans.empty() && low <= double(spans.back().high) + 1)
      spans.back().high = std::max(spans.back().high, limited(high));
    else
      spans.push_back({limited(low), limited(high)});
  }
  // A curve with many peaks: its narrowest gaps count as visible.
  constexpr std::size_t most = 6;
  while (spans.size() > most) {
    std::size_t narrowest = 1;
    for (std::size_t n = 2; n < spans.size(); ++n)
      if (spans[n].low - spans[n - 1].high < spans[narrowest].low - spans[narrowest - 1].high) narrowest = n;
    spans[narrowest - 1].high = spans[narrowest].high;
    spans.erase(spans.begin() + std::ptrdiff_t(narrowest));
  }
  return spans;
}

void VisibleCells::begin(glm::ivec3 size, const StoredDensities& densities, const CurveTable& curve,
                         const std::vector<std::uint8_t>& visible) {
  size_ = size;
  count_ = (size + (edge - 1)) / edge;
  densities_ = densities;
  spans_ = spansOf(curve);
  stateWords_ = (count_.x + statesAWord - 1) / statesAWord;
  // Leaves room to read the words beside, behind and above the last block.
  words_.resize(visible.size() + std::size_t(count_.x) * count_.y + count_.x + 1);
  states_.resize(std::size_t(stateWords_) * count_.y * count_.z);
  parallelFor(std::int64_t(count_.y) * count_.z, 0, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t row = first; row < last; ++row) {
      const std::uint8_t* isVisible = visible.data() + row * count_.x;
      const auto words = words_.begin() + row * count_.x;
      const auto states = states_.begin() + row * stateWords_;
      std::fill_n(states, stateWords_, 0);
      std::transform(isVisible, isVisible + count_.x, words,
                     [&](std::uint8_t v) { return v && !densities ? ~std::uint64_t(0) : 0; });
      for (int a = 0; densities && a < count_.x; a += 8)
        states[a / statesAWord] |= bitsOf(isVisible + a, std::min(8, count_.x - a)) << a % statesAWord;
    }
  });
}

void VisibleCells::lookInto(glm::vec3 low, glm::vec3 high) const {
  forRows(count_, low, high, [&](glm::ivec3 block, int last) {
    auto* states = states_.data() + rowAt(block) * stateWords_;
    for (int n = block.x / statesAWord; n <= last / statesAWord; ++n) {
      const int begin = std::max(block.x - n * statesAWord, 0),
                end = std::min(last - n * statesAWord, statesAWord - 1);
      const std::uint64_t word = std::atomic_ref(states[n]).load(std::memory_order_acquire);
      const std::uint32_t asked = ~std::uint32_t(0) >> (statesAWord - 1 - end + begin) << begin;
      for (std::uint32_t left = std::uint32_t(word | word >> statesAWord) & asked; left; left &= left - 1)
        lookInto({n * statesAWord + std::countr_zero(left), block.y, block.z}, states[n]);
    }
  });
}

void VisibleCells::prefetch(glm::vec3 low, glm::vec3 high) const {
  constexpr int lineBlocks = 64 / sizeof(words_[0]);
  forRows(count_, low, high, [&](glm::ivec3 first, int last) {
    const std::size_t row = rowAt(first) * count_.x;
    for (std::size_t n = (row + first.x) / lineBlocks; n <= (row + last) / lineBlocks; ++n)
      __builtin_prefetch(words_.data() + n * lineBlocks);
  });
}

void VisibleCells::lookInto(glm::ivec3 block, std::uint64_t& word) const {
  const std::atomic_ref states(word);
  const std::uint64_t wanted = std::uint64_t(1) << block.x % statesAWord, busy = wanted << statesAWord;
  std::uint64_t now = states.load(std::memory_order_acquire);
  while (!(now & wanted &&
           states.compare_exchange_weak(now, now ^ (wanted | busy), std::memory_order_acquire))) {
    if (!(now & (wanted | busy))) return;
    now = states.load(std::memory_order_acquire);
  }
  words_[rowAt(block) * count_.x + block.x] = cellsOf(block);
  states.fetch_and(~busy, std::memory_order_release);
}

std::uint64_t VisibleCells::cellsOf(glm::ivec3 block) const {
  constexpr int voxels = edge + 1;  // Number of voxels along an edge of a block of cells.
  const glm::ivec3 first = block * edge;
  RowRange alongK[edge][voxels];  // Indices: cells along k, rows of voxels along j.
  for (int j = 0; j < voxels; ++j) {
    RowRange rows[voxels];
    for (int k = 0; k < voxels; ++k) rows[k].low = rows[k].high = rowOf(first + glm::ivec3(0, j, k));
    for (int k = 0; k < edge; ++k) {
      alongK[k][j] = rows[k];
      takeIn(rows[k + 1], alongK[k][j]);
    }
  }
  std::uint64_t cells = 0;
  for (int k = 0; k < edge; ++k)
    for (int j = 0; j < edge; ++j) {
      RowRange range = alongK[k][j];
      takeIn(alongK[k][j + 1], range);
      std::array<std::uint8_t, 8> seen{};
      for (int i = 0; i < edge; ++i) {
        const std::int16_t low = std::min(range.low[i], range.low[i + 1]),
                           high = std::max(range.high[i], range.high[i + 1]);
        for (const Span& s : spans_) seen[i] |= std::uint8_t(high >= s.low && low <= s.high);
      }
      cells |= bitsOf(seen.data()) << (4 * j + 16 * k);
    }
  return cells;
}

VisibleCells::Row VisibleCells::rowOf(glm::ivec3 voxel) const {
  const glm::ivec3 inside = glm::min(voxel, size_ - 1);
  const std::size_t begin = (std::size_t(inside.z) * size_.y + inside.y) * densities_.rowVoxels;
  Row row;
  const auto take = [&](const auto* from, int stride) {
    for (int i = 0; i < int(row.size()); ++i) row[i] = from[stride * std::min(voxel.x + i, size_.x - 1)];
  };
  if (densities_.in8)
    take(densities_.in8 + std::size_t(densities_.stride8) * begin, densities_.stride8);
  else if (voxel.x + int(row.size()) <= size_.x)
    std::memcpy(row.data(), densities_.in16 + begin + voxel.x, sizeof(row));
  else
    take(densities_.in16 + begin, 1);
  for (auto& v : row) v = std::int16_t(v ^ densities_.flip);
  return row;
}

}  // namespace volumen
