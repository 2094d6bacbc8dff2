#pragma once

#include <span>
#include <string>

#include "io/export/segments_file.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Writes the segments of a label map, each the voxels of its number, as a segmentation that 3D Slicer opens:
/// `path` is NRRD (by custom .seg.nrrd) with the fields of Slicer's segmentation format: names, colours
/// (white where a segment has none) and codes (TerminologyEntry; "^", "~" and "|" of their texts become
/// blanks). The file appears whole or not at all; an Error names it.
Status writeSegNrrd(const LabelMap& map, std::span<const Segment> segments, const std::string& path,
                    const CancelToken& cancel = {});
/// The same of several maps of one grid, whose segments may overlap: each is a layer.
Status writeSegNrrd(std::span<const Segmented> maps, const std::string& path, const CancelToken& cancel = {});

/// Reads a segmentation of 3D Slicer (or one written here), one map a layer. A NRRD file of labels without
/// Slicer's fields gives a segment for each number. Numbers above 255 become labels that are free. The Error
/// names the file: it is no NRRD file, damaged, of more than 255 segments a layer, holds values that are no
/// labels, or its fields contradict each other.
Result<SegmentsFile> readSegNrrd(const std::string& path, const Progress& progress = {},
                                 const CancelToken& cancel = {});

}  // namespace volumen
