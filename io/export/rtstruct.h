#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/export/study_object.h"
#include "viewer/segment/segmented.h"

namespace volumen {

/// What a structure set says of itself.
struct StructureSetTags : ObjectTags {
  std::string label = "Segments";  ///< StructureSetLabel: at most 16 characters
};

/// Writes segments on a grid of a DICOM series as an RT Structure Set (PS3.3 A.19) into a new file. Its
/// contours run along the edges of the pixels of the acquired slices (holes joined by keyholes), so that
/// filling by pixel centres gives the pixels back: those whose centre lies in a voxel of the segment.
/// Segments are renumbered from 1 and keep names, codes and colours; those without a pixel are left out.
/// Returns notes for the user: segments left out, volumes in ml where contours cannot hold them, oblique
/// slices, names cut. The Error: the path exists or cannot be written, the series is not from DICOM files,
/// or these have changed or have no position or UIDs of their own (checkNames()). Also: no slice has a marked
/// pixel, or the export was cancelled.
Result<std::vector<std::string>> writeStructureSet(std::span<const Segmented> maps, const Series& series,
                                                   const StructureSetTags& tags, const std::string& path,
                                                   const Progress& progress = {},
                                                   const CancelToken& cancel = {});

}  // namespace volumen
