#include "viewer/register/sampled_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "viewer/volume/histogram.h"

namespace volumen {

namespace {

// Returns the block size in voxels along each axis.
glm::ivec3 blockOf(const VoxelGeometry& geometry, double mm, int most) {
  glm::ivec3 block(1);
  for (int axis = 0; axis < 3; ++axis) {
    const int wanted = int(mm / geometry.spacing()[axis]), fewest = (geometry.size[axis] + most - 1) / most;
    block[axis] = std::clamp(std::max(wanted, fewest), 1, geometry.size[axis]);
  }
  return block;
}

float blockMean(const Volume& volume, glm::ivec3 from, glm::ivec3 block, float low, float high) {
  double sum = 0;
  for (int k = from.z; k < from.z + block.z; ++k)
    for (int j = from.y; j < from.y + block.y; ++j)
      for (int i = from.x; i < from.x + block.x; ++i) sum += std::clamp(volume.value(i, j, k), low, high);
  return float(sum / (double(block.x) * block.y * block.z));
}

}  // namespace

SampledGrid sampledGrid(const Volume& volume, double mm, int most, const CancelToken& cancel) {
  const VoxelGeometry& from = volume.geometry();
  const glm::ivec3 block = blockOf(from, mm, most);
  SampledGrid grid{from, {}};
  grid.geometry.size = from.size / block;
  for (int axis = 0; axis < 3; ++axis) grid.geometry.patientFromVoxelStep[axis] *= block[axis];
  grid.geometry.origin = from.patientFromVoxel(glm::dvec3(block - 1) * 0.5);
  const std::vector<float> limits = percentiles(volume, {1, 999});
  const glm::ivec3 n = grid.geometry.size;
  grid.values.reserve(std::size_t(grid.geometry.voxelCount()));
  for (int k = 0; k < n.z && !cancel.cancelled(); ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i)
        grid.values.push_back(blockMean(volume, glm::ivec3(i, j, k) * block, block, limits[0], limits[1]));
  return grid;
}

}  // namespace volumen
