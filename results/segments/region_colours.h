#pragma once

#include <QColor>
#include <glm/vec3.hpp>
#include <optional>

namespace volumen {

/// Returns the colour of a region or segment: the file's, else one of a few distinct ones by its number.
QColor regionColour(const std::optional<glm::u8vec3>& ofFile, int number);

}  // namespace volumen
