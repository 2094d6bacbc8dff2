#include "viewer/segment/packed_bits.h"

#include <algorithm>
#include <bit>
#include <cstring>

static_assert(std::endian::native == std::endian::little, "words are copied as bytes");

namespace volumen {

void unpackBits(std::span<const std::uint8_t> bytes, std::size_t first, std::span<std::uint8_t> values) {
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = bitAt(bytes, first + n);
}

void unpackWords(std::span<const std::uint8_t> bytes, std::size_t first, std::size_t count,
                 std::span<std::uint64_t> words) {
  const std::size_t shift = first % 8;
  for (std::size_t done = 0; done < count; done += 64) {
    const std::size_t bits = std::min<std::size_t>(64, count - done), at = (first + done) / 8;
    const std::size_t held = (shift + bits + 7) / 8;  // bytes, at most 9
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(held, 8));
    word >>= shift;
    if (held == 9) word |= std::uint64_t(bytes[at + 8]) << (64 - shift);
    words[done / 64] = bits == 64 ? word : word & ((std::uint64_t(1) << bits) - 1);
  }
}

void BitPacker::add(std::span<const std::uint64_t> words, std::size_t count) {
  for (std::size_t done = 0; done < count; done += 64)
    add(words[done / 64], int(std::min<std::size_t>(64, count - done)));
}

std::vector<std::uint8_t> BitPacker::bytes() const {
  std::vector<std::uint8_t> all((size_ + 15) / 16 * 2);
  if (!all.empty()) std::memcpy(all.data(), words_.data(), all.size());
  return all;
}

}  // namespace volumen
