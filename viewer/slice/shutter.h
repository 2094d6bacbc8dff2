#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace volumen {

/// One shape of a display shutter (PS3.3 C.7.6.11): what it leaves free. Pixels are counted from 1, as in the
/// file, x along a row.
struct ShutterShape {
  enum class Kind { rectangle, circle, polygon } kind = Kind::rectangle;
  glm::dvec2 from{0}, to{0};        ///< rectangle: its first and last pixel
  glm::dvec2 centre{0};             ///< circle
  double radius = 0;                ///< circle: in pixels along a row, above 0
  std::vector<glm::dvec2> corners;  ///< polygon: 3 to 4096
};

/// The shapes of a shutter; what lies outside any of them is hidden behind one grey.
struct Shutter {
  std::vector<ShutterShape> shapes;
  float grey = 0;  ///< 0 black .. 1 white (ShutterPresentationValue)
};

/// What the shapes hide of a picture of this size: one byte a pixel, 1 where hidden; empty where nothing is.
/// Of circles and polygons the pixels whose centre lies inside or on the edge stay free. `pixelMm`: the
/// shape of a pixel.
std::vector<std::uint8_t> hiddenBy(const Shutter& shutter, glm::ivec2 size, glm::dvec2 pixelMm);

}  // namespace volumen
