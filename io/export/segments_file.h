#pragma once

#include <string>
#include <vector>

#include "viewer/segment/segmented.h"
#include "viewer/volume/result.h"

namespace volumen {

/// What a file of segments holds: a label map a layer, all of one grid.
struct SegmentsFile {
  std::vector<Segmented> maps;
  std::vector<std::string> notes;  ///< sentences that are to be known
};

/// The same on the grid of a volume, told where it is another one: each voxel has what the voxel of the file
/// that holds its centre has. The Error: it has no position, and is not of that size.
Result<SegmentsFile> onGrid(SegmentsFile file, const VoxelGeometry& grid);

}  // namespace volumen
