#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "viewer/segment/surface.h"

namespace volumen {

/// Returns two points of a surface with the largest distance between them (exact). The surface must have
/// points.
std::array<glm::vec3, 2> farthestPoints(const Surface& surface);

}  // namespace volumen
