#include "viewer/segment/labels_on.h"

#include <algorithm>
#include <glm/common.hpp>

#include "viewer/volume/buffer.h"
#include "viewer/volume/parallel.h"

namespace volumen {

// Checking the corners suffices, because positions are linear.
bool areSameVoxels(const VoxelGeometry& a, const VoxelGeometry& b) {
  constexpr double off = 0.49;  // less than half a voxel
  if (a.size != b.size) return false;
  for (const int x : {0, a.size.x - 1})
    for (const int y : {0, a.size.y - 1})
      for (const int z : {0, a.size.z - 1}) {
        const glm::dvec3 voxel(x, y, z),
            from = glm::abs(b.voxelFromPatient(a.patientFromVoxel(voxel)) - voxel);
        if (!(std::max({from.x, from.y, from.z}) < off)) return false;
      }
  return true;
}

LabelMap labelsOn(const LabelMap& map, const VoxelGeometry& grid) {
  DenseLabels held = map.dense();
  if (areSameVoxels(map.geometry(), grid)) {
    held.geometry = grid;
    return LabelMap(held);
  }
  const glm::ivec3 size = held.geometry.size;
  const glm::dvec3 high = glm::dvec3(size);
  DenseLabels made{grid, zeros<std::uint8_t>(std::size_t(grid.voxelCount()))};
  const glm::dvec3 step = held.geometry.voxelFromPatientStep() * grid.patientFromVoxelStep[0];
  parallelFor(std::int64_t(grid.size.y) * grid.size.z, 0, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row) {
      const glm::dvec3 first = held.geometry.voxelFromPatient(
          grid.patientFromVoxel({0, double(row % grid.size.y), double(row / grid.size.y)}));
      for (int i = 0; i < grid.size.x; ++i) {
        const glm::dvec3 v = glm::floor(first + double(i) * step + 0.5);
        if (!(v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < high.x && v.y < high.y && v.z < high.z)) continue;
        const glm::ivec3 from(v);
        made.labels[std::size_t(row * grid.size.x + i)] =
            held.labels[(std::size_t(from.z) * std::size_t(size.y) + std::size_t(from.y)) *
                            std::size_t(size.x) +
                        std::size_t(from.x)];
      }
    }
  });
  return LabelMap(made);
}

}  // namespace volumen
