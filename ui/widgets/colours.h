#pragma once

#include <QColor>
#include <algorithm>
#include <glm/vec3.hpp>

namespace volumen {

/// Converts display RGB 0..1 to a QColor, and back.
inline QColor toQColor(glm::dvec3 c) {
  return QColor::fromRgbF(float(std::clamp(c.x, 0.0, 1.0)), float(std::clamp(c.y, 0.0, 1.0)),
                          float(std::clamp(c.z, 0.0, 1.0)));
}

/// Colour of a value range while it is chosen, in slices and on the curve's axis.
inline constexpr QRgb rangeTint = 0xffff6a3d;

inline glm::dvec3 fromQColor(const QColor& c) { return glm::dvec3(c.red(), c.green(), c.blue()) / 255.0; }

}  // namespace volumen
