#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace volumen {

/// Bits one behind the other without gaps, the lowest of a byte first, as DICOM keeps pixels of one bit,
/// frame after frame (PS3.5 8.1.1): neither rows nor frames begin on a byte.
inline bool bitAt(std::span<const std::uint8_t> bytes, std::size_t bit) {
  return bytes[bit / 8] >> bit % 8 & 1;
}

/// The bits from `first` on as a 0 or 1 each. `bytes` holds them all.
void unpackBits(std::span<const std::uint8_t> bytes, std::size_t first, std::span<std::uint8_t> values);

/// The same as words of 64 bits, the lowest first; bits of the last word behind `count` are 0.
void unpackWords(std::span<const std::uint8_t> bytes, std::size_t first, std::size_t count,
                 std::span<std::uint64_t> words);

/// Puts bits one behind the other.
class BitPacker {
 public:
  /// The lowest `count` bits, at most 64; those above are 0.
  void add(std::uint64_t bits, int count) {
    const int at = int(size_ % 64);
    if (at == 0) words_.push_back(0);
    words_.back() |= bits << at;
    if (at + count > 64) words_.push_back(bits >> (64 - at));
    size_ += std::size_t(count);
  }
  /// The first `count` bits of words.
  void add(std::span<const std::uint64_t> words, std::size_t count);

  std::size_t size() const { return size_; }  ///< bits
  /// An even number of bytes.
  std::vector<std::uint8_t> bytes() const;

 private:
  std::vector<std::uint64_t> words_;
  std::size_t size_ = 0;
};

}  // namespace volumen
