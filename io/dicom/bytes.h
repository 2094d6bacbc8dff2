#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>

namespace volumen::dicom {

using Bytes = std::span<const std::uint8_t>;

/// Returns the number of type T at `offset` in the given byte order. The bytes must exist.
template <class T>
T numberAt(Bytes bytes, std::uint64_t offset, bool bigEndian) {
  std::uint8_t raw[sizeof(T)];
  for (std::size_t n = 0; n < sizeof(T); ++n)
    raw[n] =
        bytes[offset + ((bigEndian != (std::endian::native == std::endian::big)) ? sizeof(T) - 1 - n : n)];
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

/// Swaps the bytes of every 16-bit word. An odd last byte stays.
inline void swapBytesOfWords(std::span<std::uint8_t> bytes) {
  for (std::size_t n = 0; n + 1 < bytes.size(); n += 2) std::swap(bytes[n], bytes[n + 1]);
}

}  // namespace volumen::dicom
