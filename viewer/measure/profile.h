#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "viewer/measure/shape.h"
#include "viewer/slice/plane.h"

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

/// How often values occur, in bins of one width.
struct ValueCounts {
  double low = 0,
         width = 1;  ///< of the first bin; it holds low <= v < low + width, the last one its end, too
  std::vector<std::int64_t> counts;  ///< empty: there are no values
};

/// Of the voxels of a region (forEachVoxelOf()), at most `mostBins` bins. Whole numbers have bins of a whole
/// width about them (low is a half), so that none holds more of them than another; equal values have one bin.
ValueCounts countsOf(const Shape& region, const Volume& volume, int mostBins = 64);

}  // namespace volumen
