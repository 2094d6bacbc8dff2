#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace volumen {

/// What the distance of two values fits in: as narrow as they are, so that vectors hold many.
template <class T>
using Distance = typename std::conditional_t<std::is_floating_point_v<T>, std::type_identity<T>,
                                             std::make_unsigned<T>>::type;

/// Passes over rows of stored values, SIMD; the same numbers on every processor.
template <class T>
struct RowPasses {
  /// Smallest and largest of `count` values, at least one.
  std::pair<T, T> (*rangeOf)(const T* values, std::size_t count);
  /// Takes each value in: afterwards low[n] <= values[n] <= high[n].
  void (*takeInRange)(const T* values, std::size_t count, T* low, T* high);
  /// Takes each distance in: afterwards |b[n] - a[n]| <= most[n].
  void (*takeInDistance)(const T* a, const T* b, std::size_t count, Distance<T>* most);
};

/// By the best instructions that the processor has; for std::uint8_t, std::int16_t, std::uint16_t and finite
/// floats.
template <class T>
const RowPasses<T>& rowPasses();

}  // namespace volumen
