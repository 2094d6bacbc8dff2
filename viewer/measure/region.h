#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "viewer/measure/shape.h"

namespace volumen {

/// Values of voxels, real units.
struct ValueStatistics {
  std::int64_t n = 0;  ///< voxels
  double mean = 0;
  double sd = 0;  ///< of these n values, divided by n
  double min = 0, max = 0;
};

/// Calls visit(index, value in real units) with each voxel of a region (slices.md 4): their centres' feet lie
/// inside its outline (contains()), and they lie within half a voxel along the plane's normal: of each column
/// of voxels along the axis closest to the normal exactly one, the centre within -1/2 <= q < 1/2 steps of
/// that axis. A centre within 1e-6 step of the limit counts as on it, so that rounding never leaves a plane
/// halfway between slices without voxels. Padding is left out.
void forEachVoxelOf(const Shape& region, const Volume& volume,
                    const std::function<void(glm::ivec3 voxel, double value)>& visit);

/// Of all of them. None: no voxel inside.
std::optional<ValueStatistics> regionValues(const Shape& region, const Volume& volume);

}  // namespace volumen
