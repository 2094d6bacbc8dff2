#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <type_traits>

namespace volumen {

/// Numbers at fixed positions of a binary header. The caller checks that the header is long enough.
struct HeaderNumbers {
  const std::string& head;
  bool bigEndian;

  template <class T>
  T at(std::size_t place) const {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), head.data() + place, sizeof(T));
    if (bigEndian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }
  template <class T, class To, std::size_t N>
  void row(std::size_t place, std::array<To, N>& to) const {
    for (std::size_t n = 0; n < N; ++n) to[n] = To(at<T>(place + n * sizeof(T)));
  }
};

}  // namespace volumen
