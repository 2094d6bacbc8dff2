#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "viewer/slice/grey.h"

namespace volumen {

/// The values of a picture's pixels, first row on top. Integers stay as they are stored, with the rescale
/// that makes values of them: half the memory of floats.
struct PixelValues {
  VoxelValues stored;               ///< floats are values themselves
  double slope = 1, intercept = 0;  ///< value = slope * stored + intercept in double, rounded once to float32

  PixelValues() = default;
  PixelValues(std::vector<float> values) : stored(std::move(values)) {}
  PixelValues(VoxelValues integers, double slopeOfThem, double interceptOfThem)
      : stored(std::move(integers)), slope(slopeOfThem), intercept(interceptOfThem) {}

  std::size_t size() const;
  bool empty() const { return size() == 0; }
  float of(double storedValue) const { return float(slope * storedValue + intercept); }
  float operator[](std::size_t n) const;
  std::vector<float> floats() const;
  bool anyNegative() const;
  /// volumen::greyBytes() of all values.
  std::vector<std::uint8_t> greyBytes(const GreyMapping& mapping) const;
};

/// Collects the values of pictures that share a window; padding and what is not finite do not count.
class SharedWindow {
 public:
  void add(const PixelValues& values, const std::optional<ValueRange>& padding);
  /// P0.1 .. P99.9 of all values added (picture.md 5).
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
