#pragma once

#include <memory>
#include <set>
#include <vector>

#include "viewer/segment/label_map.h"
#include "viewer/segment/segment.h"

namespace volumen {

/// Labels on the slices of a series as acquired, one voxel a pixel.
struct AcquiredLabels {
  LabelMap labels;
  /// Segments that exist only on the grid; their labels here are the nearest grid voxels.
  std::set<int> interpolated{};
};

/// Segments that share no voxel: each occupies the voxels whose label is its number.
struct Segmented {
  std::vector<Segment> segments;
  LabelMap labels;
  /// The same on the slices as acquired. Null if unknown or if these are slices of the grid of `labels`.
  std::shared_ptr<const AcquiredLabels> acquired{};
};

}  // namespace volumen
