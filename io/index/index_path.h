#pragma once

#include <string>

#include "io/study/progress.h"
#include "io/study/study.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Opens a user's PATH argument. For "index:STUDY[/SERIES]" that is the study or series in the user's index,
/// with unreadable files beside it; for all others it is openStudy(). STUDY is a StudyInstanceUID or a number
/// of `volumen list`, SERIES a SeriesInstanceUID or its number. The Error: nothing matches, or more than one.
Result<Study> openPath(const std::string& path, const Progress& progress = {},
                       const CancelToken& cancel = {});

}  // namespace volumen
