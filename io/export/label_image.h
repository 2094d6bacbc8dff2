#pragma once

#include <string>

#include "io/export/segments_file.h"
#include "io/study/progress.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Writes the labels of segments as an 8-bit image: .nii.gz, .mha or .nrrd by the ending of `path`
/// (writeVolume()). The table of names and colours that ITK-SNAP reads (label_table.h) is written beside it.
/// Slicer reads the image, but takes names only from .seg.nrrd. Each file appears whole or not at all.
/// Neither file holds codes.
Status writeLabelImage(const Segmented& segments, const std::string& path, const Progress& progress = {},
                       const CancelToken& cancel = {});

/// Reads a label image in any volume format, and the table beside it if there is one. A label without a row
/// is named "Label 7". Labels above 255 become free ones. A table with an unreadable line is left out, with a
/// note. The Error names the file: it cannot be read, or holds several volumes, values that are not labels,
/// or more than 255 labels, or the table has two rows for one label.
Result<SegmentsFile> readLabelImage(const std::string& path, const Progress& progress = {},
                                    const CancelToken& cancel = {});

}  // namespace volumen
