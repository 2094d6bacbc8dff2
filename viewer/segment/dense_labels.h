#pragma once

#include <cstdint>
#include <vector>

#include "viewer/volume/volume.h"

namespace volumen {

/// One label a voxel in one piece, i fastest: what algorithms work on. 0 is background.
struct DenseLabels {
  VoxelGeometry geometry;
  std::vector<std::uint8_t> labels;  ///< geometry.voxelCount() of them
};

}  // namespace volumen
