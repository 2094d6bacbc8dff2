#pragma once

#include <string>
#include <vector>

#include "io/study/progress.h"
#include "io/study/study.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Returns whether a PATH argument names a phantom, or a study of the index or of an archive, not a file.
bool isStudyName(const std::string& path);

/// Returns the files of a PATH argument: of a study in the index or in an archive, else all below the path.
Result<std::vector<std::string>> filesOfPath(const std::string& path, const Progress& progress,
                                             const CancelToken& cancel);

/// Opens a user's PATH argument. For "index:STUDY[/SERIES]" that is the study or series in the user's index,
/// with unreadable files beside it; STUDY is a StudyInstanceUID or a number of `volumen list`, SERIES a
/// SeriesInstanceUID or its number. "archive:NAME/STUDY[/SERIES]" is fetched first (fetchPath()). For all
/// others it is openStudy(). The Error: nothing matches, or more than one.
Result<Study> openPath(const std::string& path, const Progress& progress = {},
                       const CancelToken& cancel = {});

}  // namespace volumen
