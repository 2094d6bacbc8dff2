#pragma once

#include <string>
#include <vector>

#include "io/study/loaded.h"
#include "viewer/segment/segmentation.h"
#include "viewer/volume/result.h"

namespace volumen {

/// The slices of a series as acquired, where some of them are not drawn.
inline AcquiredSlices acquiredSlicesOf(const Loaded& series) {
  return series.places.empty() ? AcquiredSlices{} : AcquiredSlices{series.acquired, series.places};
}

/// What a file of segments holds: a label map a layer, all of one grid.
struct SegmentsFile {
  std::vector<Segmented> maps{};
  std::vector<std::string> notes{};     ///< sentences that are to be known
  std::vector<std::string> files{};     ///< all that were read for it: the table of names, files of data, too
  std::string frameOfReferenceUid{};    ///< of a DICOM segmentation that says it
  std::vector<std::string> pictures{};  ///< SOP instance UIDs of what it names
};

/// The same on the grid of a volume: each voxel has what the voxel of the file that holds its centre has.
/// What that changes and what lies outside is told in ml; `whose` grid it is, in these sentences. The Error:
/// it has no position, and is not of that size; all of it lies outside.
Result<SegmentsFile> onGrid(SegmentsFile file, const VoxelGeometry& grid,
                            const std::string& whose = "the series");
/// The segments of an object on the grid of a volume (segmentedOf), with what that changes. The Error: the
/// volume has no position; all of it lies outside.
Result<SegmentsFile> onGrid(const Segmentation& segmentation, const VoxelGeometry& grid,
                            const CancelToken& cancel = {}, const AcquiredSlices& slices = {});

}  // namespace volumen
