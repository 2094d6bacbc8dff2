#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/segment/occupancy.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Triangles in patient space (LPS, mm), anticlockwise seen from outside.
struct Surface {
  std::vector<glm::vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Where the field is 1/2: closed (every edge is in exactly two triangles, once in each direction) on every
/// grid, mirrored and sheared ones too. In each cell the crossings of its edges are joined to loops, corners
/// inside parted on a face where they are opposite, and these divided into triangles (cell_triangles.h). No
/// crossing is nearer to a point of the grid than 0.02 of its edge. The same bytes for any number of threads.
/// The Error: cancelled, too little memory, or 2^31 triangles or more.
Result<Surface> surfaceOf(const OccupancyField& field, const CancelToken& cancel = {});

/// The same triangles with their points where the field is a little less or more than 1/2 (at most 0.05), all at
/// the same value, found so that they enclose volumeOf(field) to 0.01 %: flat triangles on a round surface lack
/// some of it. Where corners inside are opposite on many faces (noise) that value may not be enough. Points stay
/// on their edges, so it is as closed as that one.
Result<Surface> volumePreservingSurface(const OccupancyField& field, const CancelToken& cancel = {});

/// Of a closed surface, mm^3 and mm^2; the same digits for any number of threads.
double volumeOf(const Surface& surface);
double areaOf(const Surface& surface);
/// The volumes inside each of its closed shells, mm^3, the largest first; those of cavities are below 0.
std::vector<double> shellVolumes(const Surface& surface);

/// Fewer triangles by collapsing edges, in order of their quadric error, while the surface stays closed (link
/// condition), no normal turns by more than 60 degrees and no point moves farther than toleranceMm from the
/// planes that it came from. Cancelled: as far as it has come by then. (Garland and Heckbert 1997)
Surface reduced(Surface surface, double toleranceMm, const CancelToken& cancel = {});

/// Distances (mm) of `of` from `to`, exact: the largest from the corners and middles of its triangles, and
/// the mean from their middles, weighted by area. 0 where one has no triangles; cancelled, they are not true.
struct Deviation {
  double largest = 0, mean = 0;
};
Deviation deviation(const Surface& of, const Surface& to, const CancelToken& cancel = {});

}  // namespace volumen
