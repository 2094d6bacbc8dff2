#pragma once

#include <string>

#include "io/study/progress.h"
#include "io/study/study.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// All that a user names by PATH: of "index:STUDY[/SERIES]" what the user's index knows of a study or of one
/// of its series, and what beside them could not be read; else openStudy() of it. STUDY is a StudyInstanceUID
/// or a number of `volumen list`, SERIES a SeriesInstanceUID or its number. An Error where nothing is meant
/// by it, or several are.
Result<Study> openPath(const std::string& path, const Progress& progress = {},
                       const CancelToken& cancel = {});

}  // namespace volumen
