#pragma once

#include <memory>
#include <set>
#include <vector>

#include "viewer/segment/label_map.h"
#include "viewer/segment/segment.h"

namespace volumen {

/// Labels on the slices of a series as acquired, a voxel a pixel.
struct AcquiredLabels {
  LabelMap labels;
  /// Segments that are only where the nearest voxels of the grid that is drawn have them.
  std::set<int> interpolated{};
};

/// Segments that share no voxel: each is where its number is the label.
struct Segmented {
  std::vector<Segment> segments;
  LabelMap labels;
  /// The same on the slices as acquired, where that is known and they are no slices of the grid of `labels`.
  std::shared_ptr<const AcquiredLabels> acquired{};
};

}  // namespace volumen
