#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace volumen {

/// Bits packed without gaps, lowest bit of a byte first, as DICOM stores 1-bit pixels frame after frame
/// (PS3.5 8.1.1). Neither rows nor frames start on a byte boundary.
inline bool bitAt(std::span<const std::uint8_t> bytes, std::size_t bit) {
  return bytes[bit / 8] >> bit % 8 & 1;
}

/// Writes the bits from `first` on as 0 or 1, one per value. `bytes` must hold them all.
void unpackBits(std::span<const std::uint8_t> bytes, std::size_t first, std::span<std::uint8_t> values);

/// Writes them as 64-bit words, lowest bit first. Bits of the last word beyond `count` are 0.
void unpackWords(std::span<const std::uint8_t> bytes, std::size_t first, std::size_t count,
                 std::span<std::uint64_t> words);

/// Packs bits without gaps.
class BitPacker {
 public:
  /// Appends the lowest `count` bits (at most 64). Higher bits must be 0.
  void add(std::uint64_t bits, int count) {
    const int at = int(size_ % 64);
    if (at == 0) words_.push_back(0);
    words_.back() |= bits << at;
    if (at + count > 64) words_.push_back(bits >> (64 - at));
    size_ += std::size_t(count);
  }
  /// Appends the first `count` bits of `words`.
  void add(std::span<const std::uint64_t> words, std::size_t count);

  std::size_t size() const { return size_; }  ///< Size in bits
  /// Returns the packed bytes, padded to an even number.
  std::vector<std::uint8_t> bytes() const;

 private:
  std::vector<std::uint64_t> words_;
  std::size_t size_ = 0;
};

}  // namespace volumen
