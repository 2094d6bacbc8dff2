#include "viewer/scene/step_length.h"

#include <glm/geometric.hpp>

namespace volumen {

double stepMm(const Camera& camera, const VoxelGeometry& geometry, double stepVoxels) {
  return stepVoxels / glm::length(geometry.voxelFromPatientStep() * glm::normalize(camera.direction));
}

}  // namespace volumen
