#pragma once

#include <string>
#include <vector>

#include "viewer/segment/bit_mask.h"

namespace volumen {

/// The values of a volume in cubes of 3 mm along the axes of the patient: the grid is of one kind, however
/// that of the volume lies.
struct MeanCells {
  VoxelGeometry grid;
  std::vector<float> values;  ///< means, i fastest
  BitMask known;              ///< cubes that lie in the volume, padding left out

  std::size_t placeOf(glm::ivec3 cell) const {
    return std::size_t(cell.x) +
           std::size_t(grid.size.x) * (std::size_t(cell.y) + std::size_t(grid.size.y) * std::size_t(cell.z));
  }
};

/// Returns the means of a volume.
MeanCells meanCells(const Volume& volume);

/// Returns a value between air and matter: notAirHu for a CT in HU. Else it lies, of square roots, in the
/// middle between the mean of air and the value that divides both best (Otsu): tissues of MR differ by more
/// than dark skin and air.
double airThreshold(const MeanCells& cells, const std::string& modality);

/// Returns the voxels at whose centres values of cells, linear between them, are above 0.
BitMask voxelsAboveZero(const MeanCells& cells, const VoxelGeometry& geometry);

}  // namespace volumen
