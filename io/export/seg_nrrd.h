#pragma once

#include <span>
#include <string>

#include "io/export/identity_fields.h"
#include "io/export/segments_file.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Writes the segments of a label map as a segmentation of 3D Slicer. `path` is NRRD (usually .seg.nrrd) with
/// the fields of Slicer's format: names, colours (white if a segment has none) and codes. In
/// TerminologyEntry, "^", "~" and "|" in texts become blanks. The file appears whole or not at all; the Error
/// names it.
Status writeSegNrrd(const LabelMap& map, std::span<const Segment> segments, const std::string& path,
                    const CancelToken& cancel = {});
/// Writes several maps of one grid, one layer each; their segments may overlap. The fields of `whose` are
/// named "DICOM_PatientID" etc.
Status writeSegNrrd(std::span<const Segmented> maps, const std::string& path, const CancelToken& cancel = {},
                    const IdentityFields& whose = {});

/// Reads a segmentation of 3D Slicer, one map a layer. A NRRD label file without Slicer's fields gives one
/// segment for each label. Labels above 255 become free ones. The Error names the file: it is not NRRD or
/// damaged, has more than 255 segments in a layer, values that are not labels, or contradictory fields.
Result<SegmentsFile> readSegNrrd(const std::string& path, const Progress& progress = {},
                                 const CancelToken& cancel = {});

}  // namespace volumen
