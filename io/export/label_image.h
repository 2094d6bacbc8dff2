#pragma once

#include <string>

#include "io/export/segments_file.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Writes the labels of segments as an image of 8 bits, .nii.gz, .mha or .nrrd as `path` ends
/// (writeVolume()), and beside it the table of their names and colours (label_table.h) that ITK-SNAP reads.
/// Slicer reads the image; names it takes from .seg.nrrd. Each file appears whole or not at all. Codes are in
/// neither.
Status writeLabelImage(const Segmented& segments, const std::string& path, const Progress& progress = {},
                       const CancelToken& cancel = {});

/// Reads an image of labels, of any format that volumes are read in, and the table beside it where there is
/// one; a label without a row is named "Label 7". Numbers above 255 become labels that are free. What is
/// wrong with the table is in `notes`. The Error names the file: it cannot be read, holds several volumes,
/// values that are no labels, or more than 255 of them.
Result<SegmentsFile> readLabelImage(const std::string& path, const Progress& progress = {},
                                    const CancelToken& cancel = {});

}  // namespace volumen
