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
  double share = 0;  ///< Fraction of the line's length up to here, 0 to 1.
  double value = 0;  ///< Real units; NaN outside the volume's box.
};

/// Returns the values along a line of patient points, as a plane with this interpolation shows them
/// (slices.md 1). Samples are evenly spaced along each segment, ends included: four per voxel, but only about
/// 4000 in all. Empty if the line has no length.
std::vector<ProfilePoint> profileAlong(std::span<const glm::dvec3> line, const Volume& volume,
                                       Interpolation interpolation);

/// Returns the histogram of the voxels of a region (forEachVoxelOf()), with the bins of binsFor().
ValueCounts countsOf(const Shape& region, const Volume& volume);

}  // namespace volumen
