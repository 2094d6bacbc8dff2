#pragma once

#include "io/dicom/unread.h"
#include "io/presentation.h"
#include "io/study/loaded.h"
#include "io/study/progress.h"
#include "viewer/slice/frame.h"
#include "viewer/volume/cancel.h"

namespace volumen {
struct Study;
}

namespace volumen::dicom {

struct Inspection;

/// Sorts files by what each turned out to be into `study`: volumes and images (not in order, ids not
/// numbered), refusals, and what is no picture. `lost`: what else is known to be lost of series, or of those
/// beside it. `all`: where these are all files that there are: what a DICOMDIR lists beyond them is lost.
void findSeries(const std::vector<std::string>& files, std::vector<Inspection>& inspections,
                std::vector<LostFile> lost, bool all, Study& study);

/// Decodes the slices of a DICOM series on all cores. A slice that cannot be decoded counts as missing and is
/// named in a warning.
Result<Loaded> loadSeries(const Series& series, const Progress& progress, const CancelToken& cancel);

/// What a presentation state says of the values of a frame: its own mapping, inversion and shutter, and its
/// greys (none: all values).
struct Shown {
  ValueMapping values;
  bool inverted = false;
  Shutter shutter;
  std::vector<NamedGrey> greys;
};

/// Frame `n` (from 0) of a file as acquired, as io/frames.h says; as a presentation state has it shown, where
/// there is one. `pixels`: of a frame, as far as that is known; memory is given for so many.
Result<Frame> loadFrame(const std::string& path, int n, std::uint64_t pixels,
                        const std::optional<Shown>& shown = {});

}  // namespace volumen::dicom
