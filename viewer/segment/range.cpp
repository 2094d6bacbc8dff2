#include "viewer/segment/range.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>

#include "viewer/segment/bit_rows.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

// Stored values from `low` to `high`.
template <class T>
struct Stored {
  T low, high;
  bool holds(T value) const { return (low <= value) & (value <= high); }
};

// Returns the stored values whose real values are in the range, by bisection: real values are monotonic in
// integer stored values.
template <class T>
std::optional<Stored<T>> storedIn(const Volume& volume, ValueRange range) {
  const auto real = [&](int stored) { return double(volume.realValue(stored)); };
  int least = std::numeric_limits<T>::min(), most = std::numeric_limits<T>::max();
  const bool rises = volume.slope() > 0;
  const auto first = [&](const auto& isBehind) {  // first stored value for which isBehind() holds
    int low = least, high = most + 1;
    while (low < high) {
      const int middle = low + (high - low) / 2;
      if (isBehind(real(middle)))
        high = middle;
      else
        low = middle + 1;
    }
    return low;
  };
  const int begin = first([&](double v) { return rises ? v >= range.low : v <= range.high; });
  const int end = first([&](double v) { return rises ? v > range.high : v < range.low; });
  if (!(range.low <= range.high) || begin >= end) return {};
  return Stored<T>{T(begin), T(end - 1)};
}

// Float volumes store real values.
template <>
std::optional<Stored<float>> storedIn(const Volume&, ValueRange range) {
  if (!(range.low <= range.high)) return {};
  return Stored<float>{float(range.low), float(range.high)};
}

// Tests up to 64 values, one bit each.
template <class T, class In>
std::uint64_t bitsOf(const T* values, int count, const In& isIn) {
  std::array<std::uint8_t, 64> in{};
  if (count == 64)
    for (std::size_t n = 0; n < 64; ++n) in[n] = isIn(values[n]);
  else
    for (std::size_t n = 0; n < std::size_t(count); ++n) in[n] = isIn(values[n]);
  std::uint64_t all = 0;
  for (std::size_t n = 0; n < 64; n += 8) {
    std::uint64_t eight;
    std::memcpy(&eight, in.data() + n, 8);
    all |= bits::bitsOfBytes(eight) << n;
  }
  return all;
}

template <class T, class In>
void findAll(BitMask& mask, const std::vector<T>& values, const In& isIn) {
  const glm::ivec3 size = mask.size();
  parallelFor(std::int64_t(size.y) * size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n) {
      const T* const first = values.data() + n * size.x;
      const auto row = mask.row(int(n % size.y), int(n / size.y));
      for (int i = 0; i < size.x; i += 64)
        row[std::size_t(i) / 64] = bitsOf(first + i, std::min(64, size.x - i), isIn);
    }
  });
}

}  // namespace

BitMask voxelsInRange(const Volume& volume, ValueRange range) {
  BitMask mask(volume.geometry());
  std::visit(
      [&]<class T>(const std::vector<T>& values) {
        const auto in = storedIn<T>(volume, inFloats(range));
        if (!in) return;
        const auto& padding = volume.attributes().padding;
        const auto out = padding ? storedIn<T>(volume, inFloats(*padding)) : std::nullopt;
        if (out)
          findAll(mask, values, [in = *in, out = *out](T v) { return in.holds(v) & !out.holds(v); });
        else
          findAll(mask, values, [in = *in](T v) { return in.holds(v); });
      },
      volume.stored());
  return mask;
}

}  // namespace volumen
