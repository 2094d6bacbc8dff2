#include "viewer/volume/bytes.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

constexpr double mostByte = 255, mostSigned = 127;

// Converts stored samples to bytes.
class ToByte {
 public:
  ToByte(const Volume& volume, const ByteScale& scale)
      : slope_(volume.slope() / scale.unit), offset_((volume.intercept() - scale.low) / scale.unit + 0.5) {}
  template <class T>
  std::uint8_t operator()(T stored) const {
    return std::uint8_t(std::clamp(slope_ * double(stored) + offset_, 0.0, mostByte));
  }

 private:
  double slope_, offset_;
};

// Largest gradient component as gradientRowsBy() computes it, and the scale.
struct Largest {
  double component, scale;
};
Largest largestComponent(const Volume& volume, GradientOperator by) {
  std::atomic<float> largest = 0;
  const std::size_t count = 4 * std::size_t(volume.size().x);
  const double scale = gradientRowsBy(volume, by, [&](std::size_t, const float* xyz0) {
    float here = 0;
    for (std::size_t n = 0; n < count; ++n) here = std::max(here, std::abs(xyz0[n]));
    float before = largest;
    while (before < here && !largest.compare_exchange_weak(before, here)) {
    }
  });
  return {largest, scale};
}

}  // namespace

bool bytesHoldExactly(ValueRange range, double slope) {
  // Real values are rounded to floats, so 255 steps may measure slightly more.
  return (range.high - range.low) / std::abs(slope) < mostByte + 0.5;
}

ByteScale byteScale(const Volume& volume, ValueRange range) {
  const double slope = std::abs(volume.slope()), width = range.high - range.low;
  const bool integers = !std::holds_alternative<std::vector<float>>(volume.stored());
  if (integers && bytesHoldExactly(range, slope)) {
    // Based on the sample of the smallest value, so that bytes reproduce the samples' values to the last bit.
    const double lowest = std::round((range.low - volume.intercept()) / volume.slope());
    return {volume.slope() * lowest + volume.intercept(), slope, true};
  }
  return {range.low, width > 0 ? width / mostByte : 1, false};
}

Density8 densities8(const Volume& volume, const ByteScale& scale) {
  Density8 d{Buffer<std::uint8_t>(std::size_t(volume.geometry().voxelCount())), scale};
  const ToByte toByte(volume, scale);
  std::visit(
      [&](const auto& stored) {
        constexpr std::int64_t chunk = 1 << 18;
        const std::int64_t count = std::int64_t(stored.size());
        parallelFor((count + chunk - 1) / chunk, 0, [&](std::int64_t begin, std::int64_t end) {
          for (std::int64_t n = begin * chunk; n < std::min(count, end * chunk); ++n)
            d.bytes[n] = toByte(stored[n]);
        });
      },
      volume.stored());
  return d;
}

Voxels8 voxels8By(const Volume& volume, GradientOperator by, const ByteScale& scale) {
  const Largest largest = largestComponent(volume, by);
  const double unit = largest.component > 0 ? largest.component / mostSigned : 1;
  const glm::ivec3 size = volume.size();
  const int row = rowStride(size.x, sizeof(std::uint32_t));
  Voxels8 v{Buffer<std::uint32_t>(std::size_t(row) * size.y * size.z), scale, unit * largest.scale, row};
  const ToByte toByte(volume, scale);
  const double perUnit = 1 / unit;
  const auto signedByte = [=](float g) {
    const double units = double(g) * perUnit;
    return std::uint32_t(int(units + std::copysign(0.5, units))) & 255;
  };
  const std::size_t count = std::size_t(size.x);
  std::visit(
      [&](const auto& stored) {
        gradientRowsBy(volume, by, [&](std::size_t first, const float* xyz0) {
          std::uint32_t* const words = v.row(first / count);
          for (std::size_t n = 0; n < count; ++n) {
            const float* g = xyz0 + 4 * n;
            words[n] = signedByte(g[0]) | signedByte(g[1]) << 8 | signedByte(g[2]) << 16 |
                       std::uint32_t(toByte(stored[first + n])) << 24;
          }
        });
      },
      volume.stored());
  return v;
}

}  // namespace volumen
