#pragma once

#include <stdexcept>
#include <vector>

#include "viewer/slice/curved_volume.h"

namespace volumen::tests {

/// Returns a recipe viewed along z.
inline CurvedRecipe recipeOf(CurvedKind kind, const std::vector<glm::dvec3>& points, double halfWidth = 6) {
  return {kind, points, {0, 0, 1}, halfWidth};
}

/// Both throw if the curve cannot be laid out.
inline CurvedGrid gridOf(const CurvedRecipe& recipe, const VoxelGeometry& source) {
  const auto grid = CurvedGrid::make(recipe, source);
  if (!grid) throw std::runtime_error(grid.message());
  return *grid;
}

inline VolumePtr laidOut(const Volume& source, const CurvedRecipe& recipe) {
  const auto volume = curvedVolume(source, recipe);
  if (!volume) throw std::runtime_error(volume.message());
  return *volume;
}

/// Returns a cube of `size` voxels along each axis, centred on the patient's origin.
inline VoxelGeometry boxOf(double spacing = 1, int size = 64) {
  VoxelGeometry geometry;
  geometry.size = glm::ivec3(size);
  geometry.patientFromVoxelStep = glm::dmat3(spacing);
  geometry.origin = glm::dvec3(-spacing * (size - 1) / 2);
  return geometry;
}

}  // namespace volumen::tests
