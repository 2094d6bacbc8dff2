#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace volumen {

/// The visible area of one display shutter shape (PS3.3 C.7.6.11). Pixels count from 1 as in the file, x
/// along a row.
struct ShutterShape {
  enum class Kind { rectangle, circle, polygon } kind = Kind::rectangle;
  glm::dvec2 from{0}, to{0};        ///< Rectangle: first and last pixel
  glm::dvec2 centre{0};             ///< Circle
  double radius = 0;                ///< Circle: in pixels along a row, positive
  std::vector<glm::dvec2> corners;  ///< Polygon: 3 to 4096
};

/// The shapes of a shutter. Pixels outside any of them are hidden behind one grey.
struct Shutter {
  std::vector<ShutterShape> shapes;
  float grey = 0;  ///< 0 black .. 1 white (ShutterPresentationValue)
};

/// Returns one byte per pixel, 1 where the shutter hides an image of this size; empty if it hides nothing.
/// For circles and polygons, pixels with their centre inside or on the edge stay visible. `pixelMm` gives the
/// pixel's aspect ratio.
std::vector<std::uint8_t> hiddenBy(const Shutter& shutter, glm::ivec2 size, glm::dvec2 pixelMm);

}  // namespace volumen
