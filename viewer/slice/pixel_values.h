#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "viewer/slice/grey.h"

namespace volumen {

/// Pixel values of a picture, first row on top. Integers are kept as stored, with their rescale, in half the
/// memory of floats.
struct PixelValues {
  VoxelValues stored;               ///< floats are already values
  double slope = 1, intercept = 0;  ///< value = slope * stored + intercept in double, rounded once to float32

  PixelValues() = default;
  PixelValues(std::vector<float> values) : stored(std::move(values)) {}
  PixelValues(VoxelValues integers, double slopeOfThem, double interceptOfThem)
      : stored(std::move(integers)), slope(slopeOfThem), intercept(interceptOfThem) {}

  std::size_t size() const;
  bool empty() const { return size() == 0; }
  float of(double storedValue) const { return float(slope * storedValue + intercept); }
  float operator[](std::size_t n) const;
  std::vector<float> floats() const { return floats(0, size()); }
  /// Returns `count` values from the one at `first` on.
  std::vector<float> floats(std::size_t first, std::size_t count) const;
  bool anyNegative() const;
  /// Returns volumen::greyBytes() of all values.
  std::vector<std::uint8_t> greyBytes(const GreyMapping& mapping) const;
};

/// Maps stored values to values by a rescale, or by a table that replaces it (PS3.3 C.11.1).
struct ValueMapping {
  double slope = 1, intercept = 0;
  double first = 0;                  ///< stored value of the table's first entry
  std::vector<std::uint16_t> table;  ///< empty: the rescale applies
  std::string unit;                  ///< "HU"; empty: unknown

  float operator()(double stored) const;
  bool operator==(const ValueMapping&) const = default;
};

/// Counts the values of pictures that share a window, without padding and non-finite values.
class SharedWindow {
 public:
  void add(const PixelValues& values, const std::optional<ValueRange>& padding);
  /// Returns P0.1 .. P99.9 of all added values (picture.md 5).
  Window window() const;

 private:
  struct Counted {
    float value;
    std::int64_t times;
  };
  std::vector<Counted> counted_;
  std::int64_t count_ = 0;
};

}  // namespace volumen
