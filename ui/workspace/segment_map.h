#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/data/series_key.h"
#include "viewer/recipe/recipe.h"
#include "viewer/segment/label_map.h"
#include "viewer/segment/segment.h"
#include "viewer/segment/tissue_shown.h"

namespace volumen {

/// What a session says of labels that lie in a file beside it.
struct SavedLabels {
  std::string checksum;  ///< checksumOf() them
  VoxelGeometry geometry;
  bool operator==(const SavedLabels&) const = default;
};

/// Segments of a series that share no voxel: the label of each voxel of the grid that is drawn, and what each
/// label is. What overlaps them is in further maps of the series.
struct SegmentMap {
  SeriesKey series;
  std::vector<Segment> segments;           ///< each the voxels of its number
  std::shared_ptr<const LabelMap> labels;  ///< null: the file that holds them was not read
  std::optional<SavedLabels> missing;      ///< where they were not: which they are
  int current = 0;                         ///< the number of the one that is worked on; 0: the first
  bool in3d = true;           ///< those that are shown are drawn in 3D, too, not in slices alone;
                              ///< the same in all maps of a series
  std::vector<Step> steps{};  ///< how they were made (segment_record.h)
  TissueShown tissue{};       ///< of the volume itself in 3D, by the segments that are shown; the
                              ///< same in all maps of a series
  int number{};               ///< which of the maps of its series, from 0
  bool operator==(const SegmentMap& other) const;
};

/// 40 hexadecimal digits (BLAKE2b) of size and labels: the same for equal ones, whatever they share.
std::string checksumOf(const LabelMap& labels);

/// The labels as a session names them. The checksum of labels that are held is reckoned once; from any
/// thread.
SavedLabels savedLabelsOf(const SegmentMap& map);

}  // namespace volumen
