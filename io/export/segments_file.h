#pragma once

#include <string>
#include <vector>

#include "io/study/loaded.h"
#include "viewer/segment/segmentation.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Returns the acquired slices of a series, if some of them are not displayed.
inline AcquiredSlices acquiredSlicesOf(const Loaded& series) {
  return series.places.empty() ? AcquiredSlices{} : AcquiredSlices{series.acquired, series.places};
}

/// The contents of a segments file: one label map a layer, all on one grid.
struct SegmentsFile {
  std::vector<Segmented> maps{};
  std::vector<std::string> notes{};  ///< notes for the user
  /// all files that were read, including the table of names and data files
  std::vector<std::string> files{};
  std::string frameOfReferenceUid{};    ///< frame of reference of a DICOM segmentation; may be empty
  std::vector<std::string> pictures{};  ///< SOP instance UIDs of the images it references
};

/// Resamples the segments to the grid of a volume by nearest neighbour. Notes state in ml what that changes
/// and what lies outside; `whose` is the grid's name in them. The Error: the segments have no position and
/// another size, or all of them lie outside.
Result<SegmentsFile> onGrid(SegmentsFile file, const VoxelGeometry& grid,
                            const std::string& whose = "the series");
/// Returns the segments of a DICOM segmentation on the grid of a volume (segmentedOf), with notes on the
/// changes. The Error: the volume has no position, or all segments lie outside.
Result<SegmentsFile> onGrid(const Segmentation& segmentation, const VoxelGeometry& grid,
                            const CancelToken& cancel = {}, const AcquiredSlices& slices = {});

}  // namespace volumen
