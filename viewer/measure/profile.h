#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "viewer/measure/shape.h"
#include "viewer/slice/plane.h"
#include "viewer/volume/histogram.h"

namespace volumen {

/// A value along a line.
struct ProfilePoint {
  double share = 0;  ///< of the line's length up to here, 0 to 1
  double value = 0;  ///< real units; NaN outside the volume's box
};

/// The values along a line of patient points, as a plane of this interpolation shows them (slices.md 1):
/// evenly along each of its segments, their ends included, four to a voxel and at most 4000 in all. Empty
/// where it has no length.
std::vector<ProfilePoint> profileAlong(std::span<const glm::dvec3> line, const Volume& volume,
                                       Interpolation interpolation);

/// Of the voxels of a region (forEachVoxelOf()), in binsFor() them.
ValueCounts countsOf(const Shape& region, const Volume& volume);

}  // namespace volumen
