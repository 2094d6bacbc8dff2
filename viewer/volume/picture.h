#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace volumen {

/// A float RGBA picture, first row on top. With an opaque background, colour is clamped to 0..1 and alpha is
/// 1. With a transparent one, colour is premultiplied and clamped to 0..1, and alpha is A (picture.md 6,
/// design.md 10).
struct Picture {
  glm::ivec2 size{0};
  bool transparent = false;
  std::vector<float> rgba;  ///< 4 * size.x * size.y components

  float* row(int y) { return rgba.data() + std::size_t(4) * size.x * y; }
  const float* row(int y) const { return rgba.data() + std::size_t(4) * size.x * y; }
  bool operator==(const Picture&) const = default;
};

/// Returns a component as written and shown: floor(255 x + 1/2), x clamped to 0..1.
inline std::uint8_t toByte(float x) { return std::uint8_t(255 * std::clamp(double(x), 0.0, 1.0) + 0.5); }

/// Converts `count` pixels of premultiplied colour to 0xaarrggbb with toByte(), colours limited to their
/// alpha.
void toArgb(const float* rgba, std::size_t count, std::uint32_t* argb);

/// Returns the 8-bit picture by toByte(): 3 bytes per pixel if opaque, else 4 with straight (not
/// premultiplied) colour, 0 where alpha is 0 (picture.md 6).
std::vector<std::uint8_t> toBytes(const Picture& picture);

/// Returns the number of components that can differ between pictures: alpha is 1 over an opaque background.
inline int componentsThatDiffer(bool transparent) { return transparent ? 4 : 3; }

/// Differences of two float pictures in units of 1/255, as defined in design.md 2.
struct PictureError {
  double maximum = 0;       ///< Largest over pixels and RGBA
  double percentile99 = 0;  ///< Rank ceil(0.99 N) of the pixels' largest differences
  double rmse = 0;          ///< Over all components that can differ
  double psnrDb = 0;        ///< 20 log10(255 / rmse); infinity if rmse is 0
  double shareAbove2 = 0;   ///< Fraction of pixels off by more than 2/255
};

/// Returns the errors for pixels with these differences (1/255), the same in all components.
PictureError errorOf(const std::vector<float>& pixels255);

/// Returns errorOf() for a map of each pixel's possible error; empty if the map is.
std::optional<PictureError> estimateOf(const std::vector<float>& map255);
/// Returns whether an estimate is only float rounding, too small to be visible in any picture.
inline bool isRoundingAlone(const PictureError& estimate) { return estimate.maximum <= 0.01; }

/// Compares two pictures of the same size. `use` selects the pixels to count, one entry per pixel, non-zero
/// if counted; empty means all.
PictureError compare(const Picture& a, const Picture& b, const std::vector<std::uint8_t>& use = {});

}  // namespace volumen
