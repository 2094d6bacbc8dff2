#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace volumen {

/// Type for the distance of two values, of the same width, so that vectors hold many.
template <class T>
using Distance = typename std::conditional_t<std::is_floating_point_v<T>, std::type_identity<T>,
                                             std::make_unsigned<T>>::type;

/// SIMD passes over rows of stored values; the same numbers on every processor.
template <class T>
struct RowPasses {
  /// Returns the smallest and largest of `count` values, at least one.
  std::pair<T, T> (*rangeOf)(const T* values, std::size_t count);
  /// Extends ranges by values: afterwards low[n] <= values[n] <= high[n].
  void (*takeInRange)(const T* values, std::size_t count, T* low, T* high);
  /// Extends distances: afterwards |b[n] - a[n]| <= most[n].
  void (*takeInDistance)(const T* a, const T* b, std::size_t count, Distance<T>* most);
};

/// Returns the passes for the best instruction set of the processor; for std::uint8_t, std::int16_t,
/// std::uint16_t and finite floats.
template <class T>
const RowPasses<T>& rowPasses();

}  // namespace volumen
