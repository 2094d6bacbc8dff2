#include "results/segments/region_colours.h"

#include "viewer/segment/names_and_colours.h"

namespace volumen {

QColor regionColour(const std::optional<glm::u8vec3>& ofFile, int number) {
  const glm::u8vec3 colour = ofFile.value_or(tenColour(number));
  return {colour.x, colour.y, colour.z};
}

}  // namespace volumen
