#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/export/study_object.h"
#include "viewer/segment/segmented.h"

namespace volumen {

/// Attributes of a written structure set.
struct StructureSetTags : ObjectTags {
  std::string label = "Segments";  ///< StructureSetLabel: at most 16 characters
};

/// Writes segments on a grid of a DICOM series as an RT Structure Set (PS3.3 A.19) into a new file.
/// Contours run along pixel edges of the acquired slices, with holes joined by keyholes. A reader that fills
/// pixels by their centres gets the same pixels back. A pixel is inside if its centre lies in a voxel of the
/// segment.
/// Segments are renumbered from 1 and keep names, codes and colours. Segments without a pixel are left out.
/// Returns notes for the user: segments left out, volumes in ml that contours cannot hold, oblique slices,
/// shortened names.
/// Returns an Error if `path` exists or cannot be written, if no slice has a marked pixel, or if the export
/// was cancelled. Also returns an Error if the series is not from DICOM files, or if its files have changed
/// or lack positions or UIDs of their own (checkNames()).
Result<std::vector<std::string>> writeStructureSet(std::span<const Segmented> maps, const Series& series,
                                                   const StructureSetTags& tags, const std::string& path,
                                                   const Progress& progress = {},
                                                   const CancelToken& cancel = {});

}  // namespace volumen
