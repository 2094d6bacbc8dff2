#include "ui/workspace/region_colours.h"

#include <cstdlib>

namespace volumen {

QColor regionColour(const std::optional<glm::u8vec3>& ofFile, int number) {
  constexpr QRgb others[coloursOfNumbers] = {0xe6194b, 0x3cb44b, 0xffe119, 0x4363d8, 0xf58231,
                                             0x46f0f0, 0xf032e6, 0xbcf60c, 0xfabebe, 0x008080};
  if (ofFile) return {ofFile->x, ofFile->y, ofFile->z};
  return QColor(others[std::size_t(std::abs(std::int64_t(number))) % coloursOfNumbers]);
}

}  // namespace volumen
