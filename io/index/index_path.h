#pragma once

#include <string>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// "index:STUDY[/SERIES]": a study of the user's index, or one of its series, as a path.
bool isIndexPath(const std::string& path);

/// The files of what such a path names, and what beside them could not be read: STUDY is a StudyInstanceUID
/// or a number of `volumen list`, SERIES a SeriesInstanceUID or its number. An Error where nothing is meant
/// by it, or several are.
Result<std::vector<std::string>> filesOfIndexPath(const std::string& path);

}  // namespace volumen
