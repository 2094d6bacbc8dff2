#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "viewer/segment/surface.h"

namespace volumen {

/// Two points of a surface that are farthest from each other, exact; it has points.
std::array<glm::vec3, 2> farthestPoints(const Surface& surface);

}  // namespace volumen
