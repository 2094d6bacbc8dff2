#pragma once

#include <string>
#include <vector>

#include "io/study/progress.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Fetches the study or series that "archive:NAME/STUDY[/SERIES]" names by UIDs, from an archive of the
/// user's list, into the folder of fetched studies, where it stays. Returns its files. The Error: not all of
/// it could be fetched; what is whole is kept for the next time.
Result<std::vector<std::string>> fetchPath(const std::string& path, const Progress& progress,
                                           const CancelToken& cancel);

}  // namespace volumen
