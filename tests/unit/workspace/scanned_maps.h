#pragma once

#include <memory>

#include "results/segments/segment_maps.h"
#include "results/segments/segments.h"

namespace volumen::tests {

/// Returns a grid of 1 mm voxels.
inline VoxelGeometry gridOfMaps(glm::ivec3 size) {
  VoxelGeometry grid;
  grid.size = size;
  return grid;
}

inline Series scannedSeries() {
  Series series;
  series.path = "/data/ct";
  series.id = "1";
  return series;
}

inline const SeriesKey scanKey = keyOf(scannedSeries());

/// Returns an empty map of the scanned series.
inline SegmentMap withoutSegments(const VoxelGeometry& grid, int number = 0) {
  SegmentMap map{scanKey, {}, std::make_shared<const LabelMap>(grid), {}};
  map.number = number;
  return map;
}

}  // namespace volumen::tests
