#include "tests/unit/promises/random_segments.h"

#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "viewer/segment/occupancy.h"

namespace volumen::tests {
namespace {

using Holds = std::function<bool(glm::ivec3)>;

// Returns the position as a share of the grid, -1 .. 1 about its middle.
glm::dvec3 placeIn(glm::ivec3 voxel, glm::ivec3 size) {
  return (2.0 * glm::dvec3(voxel) + 1.0) / glm::dvec3(size) - 1.0;
}

Holds randomShape(Chance& chance, glm::ivec3 size) {
  const glm::dvec3 middle = chance.vector() * 0.8, edge = 0.2 + 0.6 * (chance.vector() * 0.5 + 0.5);
  const glm::dvec3 normal = glm::normalize(chance.vector() + glm::dvec3(1e-3));
  const double wide = chance.between(0.05, 0.4);
  const auto seed = std::uint64_t(chance.below(1 << 30));
  const int kind = chance.below(4), every = 2 + chance.below(20);
  return [=](glm::ivec3 voxel) {
    const glm::dvec3 from = placeIn(voxel, size) - middle;
    if (kind == 0) return glm::length(from / edge) <= 1;
    if (kind == 1) return glm::all(glm::lessThanEqual(glm::abs(from), edge));
    if (kind == 2) return std::abs(glm::dot(from, normal)) <= wide;
    const std::uint64_t n = seed + std::uint64_t(voxel.x + 64 * (voxel.y + 64 * voxel.z));
    return Chance(n).oneIn(every);
  };
}

std::shared_ptr<const OccupancyField> fieldOf(const VoxelGeometry& geometry, const Holds& holds) {
  BitMask mask(geometry);
  for (int k = 0; k < geometry.size.z; ++k)
    for (int j = 0; j < geometry.size.y; ++j)
      for (int i = 0; i < geometry.size.x; ++i)
        if (holds({i, j, k})) mask.set({i, j, k});
  return std::make_shared<const OccupancyField>(occupancyOf(mask, surfaceSigma));
}

// Returns the volume's grid or, one time in four, a shifted one with voxels of 0.7 to 1.2 times the size.
VoxelGeometry anyGrid(Chance& chance, const VoxelGeometry& geometry) {
  if (!chance.oneIn(4)) return geometry;
  VoxelGeometry other = geometry;
  other.size += 3;
  other.patientFromVoxelStep *= chance.between(0.7, 1.2);
  other.origin += geometry.patientFromVoxelStep * chance.vector();
  return other;
}

}  // namespace

std::vector<SegmentSurface> randomSegments(Chance& chance, const VoxelGeometry& geometry) {
  std::vector<SegmentSurface> segments(std::size_t(1 + chance.below(4)));
  Holds before = [](glm::ivec3) { return false; };
  for (SegmentSurface& s : segments) {
    Holds holds = randomShape(chance, geometry.size);
    // Leaves out voxels of the previous segment, so that both touch.
    if (!chance.oneIn(3)) holds = [holds, before](glm::ivec3 v) { return holds(v) && !before(v); };
    const double opacity = chance.oneIn(8) ? 0 : chance.oneIn(2) ? 1 : chance.between(0.05, 0.95);
    s = {fieldOf(anyGrid(chance, geometry), holds), chance.colour(), opacity};
    before = holds;
  }
  return segments;
}

}  // namespace volumen::tests
