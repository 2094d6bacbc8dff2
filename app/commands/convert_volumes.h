#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/study/progress.h"
#include "io/study/series.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Returns the volumes of the series UID that `--series` names, if there are several; else none. The Error:
/// PATH cannot be opened.
Result<std::vector<Series>> severalVolumes(const std::string& path, const std::string& series,
                                           const Progress& progress, const CancelToken& cancel);

struct WrittenVolumes {
  std::vector<std::string> notes;  ///< notes for the user
  std::vector<Unread> unread;      ///< unreadable files of the volumes
};

/// Writes volumes of one grid in their order as 4-D NIfTI, with the time step if it is known. If all b-values
/// and directions are known, they are written beside it (.bval, .bvec).
Result<WrittenVolumes> writeVolumes(const std::vector<Series>& volumes, const std::string& output,
                                    const Progress& progress, const CancelToken& cancel);

}  // namespace volumen
