#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

/// Rows of a BitMask, bit by bit: 64 bits per word, lowest first.
namespace volumen::bits {

using Row = std::span<const std::uint64_t>;

inline bool isSet(Row row, int at) { return row[std::size_t(at) / 64] >> at % 64 & 1; }

/// Returns the first set bit in [from, end) of the row with its words XORed with `flip`, or `end` if there is
/// none.
inline int firstSet(Row row, int from, int end, std::uint64_t flip = 0) {
  if (from >= end) return end;
  std::size_t word = std::size_t(from) / 64;
  std::uint64_t left = (row[word] ^ flip) >> from % 64 << from % 64;
  const std::size_t last = std::size_t(end - 1) / 64;
  while (!left && word < last) left = row[++word] ^ flip;
  return left ? std::min(int(word) * 64 + std::countr_zero(left), end) : end;
}
inline int firstUnset(Row row, int from, int end) { return firstSet(row, from, end, ~std::uint64_t(0)); }

/// Returns the begin of the run of set bits that contains `at`.
inline int beginOfRun(Row row, int at) {
  int word = at / 64;
  std::uint64_t unset = ~row[std::size_t(word)] & ~std::uint64_t(0) >> (63 - at % 64);
  while (!unset && word > 0) unset = ~row[std::size_t(--word)];
  return unset ? word * 64 + 64 - std::countl_zero(unset) : 0;
}

/// Calls run(begin, end) for each run of set bits in the first `size` bits of the row, in order.
template <class Call>
void forEachRun(Row row, int size, const Call& run) {
  for (int begin = firstSet(row, 0, size); begin < size;) {
    const int end = firstUnset(row, begin, size);
    run(begin, end);
    begin = firstSet(row, end, size);
  }
}

/// Sets the bits [begin, end); begin < end.
inline void setRun(std::span<std::uint64_t> row, int begin, int end) {
  const std::size_t first = std::size_t(begin) / 64, last = std::size_t(end - 1) / 64;
  const std::uint64_t from = ~std::uint64_t(0) << begin % 64, to = ~std::uint64_t(0) >> (63 - (end - 1) % 64);
  if (first == last) {
    row[first] |= from & to;
    return;
  }
  row[first] |= from;
  for (std::size_t word = first + 1; word < last; ++word) row[word] = ~std::uint64_t(0);
  row[last] |= to;
}

/// Returns the 64 bits from `at` on; bits outside the row are 0.
inline std::uint64_t wordAt(Row row, int at) {
  const int word = at >> 6, by = at & 63;
  const auto of = [&](int n) { return n >= 0 && n < int(row.size()) ? row[std::size_t(n)] : 0; };
  return by ? of(word) >> by | of(word + 1) << (64 - by) : of(word);
}

/// Packs the lowest bits of eight bytes into one byte; the first byte gives the lowest bit.
inline std::uint64_t bitsOfBytes(std::uint64_t eight) {
  return (eight & 0x0101010101010101) * 0x0102040810204080 >> 56;
}

}  // namespace volumen::bits
