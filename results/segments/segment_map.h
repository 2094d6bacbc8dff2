#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/study/series_key.h"
#include "viewer/recipe/recipe.h"
#include "viewer/segment/label_map.h"
#include "viewer/segment/segment.h"
#include "viewer/segment/segmented.h"
#include "viewer/segment/tissue_shown.h"

namespace volumen {

/// A session's entry for labels in a separate file.
struct SavedLabels {
  std::string checksum;  ///< result of checksumOf()
  VoxelGeometry geometry;
  bool operator==(const SavedLabels&) const = default;
};

/// Imported segments on the slices as acquired, where these are not those of the drawn grid.
struct ImportedLabels {
  AcquiredLabels onSlices;  ///< as in their file, by the numbers in the map
  LabelMap drawn;           ///< the same on the drawn grid; unchanged segments still have these voxels
};

/// Segments of a series that share no voxel: the label of each voxel of the drawn grid, and the segment of
/// each label. Overlapping segments are in further maps of the series.
struct SegmentMap {
  SeriesKey series;
  std::vector<Segment> segments;           ///< each has the voxels of its number
  std::shared_ptr<const LabelMap> labels;  ///< null: their file was not read
  std::optional<SavedLabels> missing;      ///< identifies labels that were not read
  int current = 0;                         ///< number of the segment being edited; 0: the first
  bool in3d = true;  ///< draws shown segments in 3D as well as in slices; the same in all maps of a series
  std::vector<Step> steps{};  ///< how the segments were made (segment_record.h)
  TissueShown tissue{};  ///< masking of the volume in 3D by shown segments; the same in all maps of a series
  std::shared_ptr<const ImportedLabels> imported{};  ///< null: none; not kept in sessions
  int number{};                                      ///< index among the maps of its series, from 0
  bool operator==(const SegmentMap& other) const;
};

/// Returns 40 hexadecimal digits (BLAKE2b) of size and labels. Equal labels have equal digits, whatever
/// memory they share.
std::string checksumOf(const LabelMap& labels);

/// Returns the labels' entry for a session. Computes the checksum of labels in memory once. Thread-safe.
SavedLabels savedLabelsOf(const SegmentMap& map);

}  // namespace volumen
