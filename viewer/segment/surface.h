#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "viewer/segment/occupancy.h"
#include "viewer/volume/result.h"

namespace volumen {

/// A triangle mesh in patient space (LPS, mm); triangles are anticlockwise seen from outside.
struct Surface {
  std::vector<glm::vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Returns the surface where the field is 1/2. It is closed (every edge is in exactly two triangles, once in
/// each direction) on every grid, mirrored and sheared ones too. In each cell the edge crossings are joined
/// to loops, which separate diagonally opposite inside corners on a face, and the loops are triangulated
/// (cell_triangles.h). Crossings stay at least 0.02 of an edge away from grid points. The bytes are the same
/// for any number of threads. The Error means: cancelled, too little memory, or 2^31 triangles or more.
Result<Surface> surfaceOf(const OccupancyField& field, const CancelToken& cancel = {});

/// Returns the same triangles at a slightly different level (within 0.05 of 1/2), chosen so that they enclose
/// volumeOf(field) to 0.01 %. Flat triangles on a round surface would lose volume. In noise, where inside
/// corners are often diagonally opposite, the level range may not suffice. Points stay on their edges, so the
/// surface stays closed.
Result<Surface> volumePreservingSurface(const OccupancyField& field, const CancelToken& cancel = {});

/// Volume (mm^3) and area (mm^2) of a closed surface; the same digits for any number of threads.
double volumeOf(const Surface& surface);
double areaOf(const Surface& surface);
/// Returns the volumes of the closed shells in mm^3, largest first. Shells of cavities are negative.
std::vector<double> shellVolumes(const Surface& surface);

/// Reduces triangles by edge collapses in order of quadric error (Garland and Heckbert 1997). The surface
/// stays closed (link condition), no normal turns by more than 60 degrees, and no point moves farther than
/// `toleranceMm` from the planes it came from. If cancelled, returns the surface so far.
Surface reduced(Surface surface, double toleranceMm, const CancelToken& cancel = {});

/// Exact distances from `of` to `to` in mm: `largest` over the corners and centres of its triangles, `mean`
/// over the centres, weighted by area. Both are 0 if a surface has no triangles, and undefined if cancelled.
struct Deviation {
  double largest = 0, mean = 0;
};
Deviation deviation(const Surface& of, const Surface& to, const CancelToken& cancel = {});

}  // namespace volumen
