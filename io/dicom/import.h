#pragma once

#include "io/presentation.h"
#include "viewer/slice/frame.h"

namespace volumen::dicom {

/// Sorts files that are no image files of another kind into `study`: volumes and images (not in order, ids
/// not numbered), refusals, and what is no picture.
void findSeries(const std::vector<std::string>& files, Study& study, const Progress& progress,
                const CancelToken& cancel);

/// Decodes the slices of a DICOM series on all cores. A slice that cannot be decoded counts as missing and is
/// named in a warning.
Result<Loaded> loadSeries(const Series& series, const Progress& progress, const CancelToken& cancel);

/// What a presentation state says of the values of a frame: its own mapping, inversion and shutter, and its
/// greys (none: all values).
struct Shown {
  const Presentation& presentation;
  const std::vector<NamedGrey>* greys;
};

/// Frame `n` (from 0) of a file as acquired, as io/frames.h says; as a presentation state has it shown, where
/// there is one.
Result<Frame> loadFrame(const std::string& path, int n, const std::optional<Shown>& shown = {});

}  // namespace volumen::dicom
