#pragma once

#include "io/study.h"
#include "viewer/slice/frame.h"

namespace volumen::dicom {

/// Sorts files that are no image files of another kind into `study`: volumes and images (not in order, ids
/// not numbered), refusals, and what is no picture.
void findSeries(const std::vector<std::string>& files, Study& study, const Progress& progress,
                const CancelToken& cancel);

/// Decodes the slices of a DICOM series on all cores. A slice that cannot be decoded counts as missing and is
/// named in a warning.
Result<Loaded> loadSeries(const Series& series, const Progress& progress, const CancelToken& cancel);

/// Frame `n` (from 0) of a file as acquired, as io/frames.h says.
Result<Frame> loadFrame(const std::string& path, int n);

}  // namespace volumen::dicom
