#pragma once

#include <glm/vec3.hpp>

namespace volumen {

/// A box of voxels, both ends inclusive.
struct VoxelBox {
  glm::ivec3 low{0}, high{0};
  bool operator==(const VoxelBox&) const = default;
};

}  // namespace volumen
