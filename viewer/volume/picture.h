#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace volumen {

/// Float RGBA, first row on top. Opaque background: colour clamped to 0..1, alpha 1.
/// Transparent background: premultiplied colour clamped to 0..1, alpha A (picture.md 6, design.md 10).
struct Picture {
  glm::ivec2 size{0};
  bool transparent = false;
  std::vector<float> rgba;  ///< 4 * size.x * size.y

  float* row(int y) { return rgba.data() + std::size_t(4) * size.x * y; }
  const float* row(int y) const { return rgba.data() + std::size_t(4) * size.x * y; }
  bool operator==(const Picture&) const = default;
};

/// A component as it is written and shown: floor(255 x + 1/2), x clamped to 0..1.
inline std::uint8_t toByte(float x) { return std::uint8_t(255 * std::clamp(double(x), 0.0, 1.0) + 0.5); }

/// `count` pixels of premultiplied colour as 0xaarrggbb, each component by toByte, no colour above its alpha.
void toArgb(const float* rgba, std::size_t count, std::uint32_t* argb);

/// The 8-bit picture, each component by toByte: 3 bytes a pixel where opaque, else 4 with straight (not
/// premultiplied) colour, 0 where alpha is 0 (picture.md 6).
std::vector<std::uint8_t> toBytes(const Picture& picture);

/// How two float pictures differ, in units of 1/255, as design.md 2 defines it.
struct PictureError {
  double maximum = 0;       ///< largest over pixels and RGBA
  double percentile99 = 0;  ///< rank ceil(0.99 N) of all pixels' largest difference
  double rmse = 0;          ///< over all components
  double psnrDb = 0;        ///< 20 log10(255 / rmse); infinity where rmse is 0
  double shareAbove2 = 0;   ///< share of pixels off by more than 2/255
};

/// The same of pixels that are off by so much each (largest component, 1/255); all components count as much.
PictureError errorOf(const std::vector<float>& pixels255);

/// What a picture that knows how far each pixel may be off says of all of them: errorOf(), nothing where the
/// map is empty.
std::optional<PictureError> estimateOf(const std::vector<float>& map255);
/// Whether such an estimate is of nothing but what floats round, below all that a picture could show.
inline bool isRoundingAlone(const PictureError& estimate) { return estimate.maximum <= 0.01; }

/// Compares pictures of one size. `use`: pixels to count (empty: all), one entry a pixel, non-zero = counted.
PictureError compare(const Picture& a, const Picture& b, const std::vector<std::uint8_t>& use = {});

}  // namespace volumen
