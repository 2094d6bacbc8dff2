#pragma once

#include <cstdint>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// One label per voxel in one array, i fastest, as algorithms need it. 0 is background.
struct DenseLabels {
  VoxelGeometry geometry;
  std::vector<std::uint8_t> labels;  ///< geometry.voxelCount() entries
};

}  // namespace volumen
