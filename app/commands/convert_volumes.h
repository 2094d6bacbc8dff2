#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/study/progress.h"
#include "io/study/series.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The volumes that `--series` names by the UID of a series that holds several; else none. An Error where
/// PATH cannot be opened.
Result<std::vector<Series>> severalVolumes(const std::string& path, const std::string& series,
                                           const Progress& progress, const CancelToken& cancel);

struct WrittenVolumes {
  std::vector<std::string> notes;  ///< what the user is to be told
  std::vector<Unread> unread;      ///< what of them could not be read
};

/// Writes volumes of one grid as 4-D NIfTI, in their order, with the time from one to the next where it is
/// known, and their diffusion weights and directions beside it (.bval, .bvec) where all are known.
Result<WrittenVolumes> writeVolumes(const std::vector<Series>& volumes, const std::string& output,
                                    const Progress& progress, const CancelToken& cancel);

}  // namespace volumen
