#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "viewer/measure/shape.h"

namespace volumen {

/// Statistics of the values of voxels, in real units.
struct ValueStatistics {
  std::int64_t n = 0;  ///< Number of voxels.
  double mean = 0;
  double sd = 0;  ///< Population standard deviation: the sum of squares is divided by n.
  double min = 0, max = 0;
};

/// Calls visit(index, value in real units) with each voxel of a region (slices.md 4). The foot of its centre
/// lies inside the outline (contains()), and it lies within half a voxel along the plane's normal. Each
/// column of voxels along the axis closest to the normal thus has exactly one, with its centre within -1/2 <=
/// q < 1/2 steps of that axis. A centre within 1e-6 step of the limit counts as on it, so that a plane
/// halfway between slices always has voxels. Padding is left out.
void forEachVoxelOf(const Shape& region, const Volume& volume,
                    const std::function<void(glm::ivec3 voxel, double value)>& visit);

/// Returns the statistics of all voxels of a region; empty if no voxel is inside.
std::optional<ValueStatistics> regionValues(const Shape& region, const Volume& volume);

}  // namespace volumen
