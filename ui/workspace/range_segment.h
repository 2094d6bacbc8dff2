#pragma once

#include <QString>

#include "viewer/segment/label_map.h"

namespace volumen {

/// The voxels of a value range and what they amount to.
struct RangeSegment {
  VolumePtr volume;
  ValueRange range;
  LabelMap map;
  LabelStatistics statistics;
};

/// Where and as what a segmentation is to be saved.
struct SegmentFile {
  QString path, name;
  glm::dvec3 colour{1};
};

}  // namespace volumen
