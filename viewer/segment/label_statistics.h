#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "viewer/segment/label_map.h"
#include "viewer/volume/occupancy_field.h"

namespace volumen {

/// What one label holds. Values in real units of the volume (HU for CT).
struct LabelStatistics {
  std::int64_t voxels = 0;
  std::optional<double> millilitres;  ///< none where the volume is not calibrated
  double mean = 0, min = 0, max = 0;  ///< 0 where there are no voxels
};

/// Statistics of the voxels of `label`, the same for any number of threads. `map` and `volume` are of one
/// grid.
LabelStatistics labelStatistics(const LabelMap& map, const Volume& volume, std::uint8_t label = 1);

/// How many voxels of the grid have each label.
std::array<std::int64_t, 256> labelCounts(const LabelMap& map);

/// The smallest box that holds all voxels of `label`; none where there are none.
std::optional<VoxelBox> labelBox(const LabelMap& map, std::uint8_t label = 1);

}  // namespace volumen
