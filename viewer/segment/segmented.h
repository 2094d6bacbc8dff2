#pragma once

#include <vector>

#include "viewer/segment/label_map.h"
#include "viewer/segment/segment.h"

namespace volumen {

/// Segments that share no voxel: each is where its number is the label.
struct Segmented {
  std::vector<Segment> segments;
  LabelMap labels;
};

}  // namespace volumen
