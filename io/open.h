#pragma once

#include <string>
#include <vector>

#include "io/study/progress.h"
#include "io/study/study.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// What is under `path`: a file, a folder (nested; links followed, to folders only below it, each file once),
/// a DICOMDIR (all below its folder; no links out of it), a zip archive (unpacked until the program ends) or
/// what is in one ("a.zip/CT"), or "phantom:NAME[:SIZE]".
/// Reads headers only. An Error where there is no such path; what cannot be loaded is in `refused` with its
/// reason.
Result<Study> openStudy(const std::string& path, const Progress& progress = {},
                        const CancelToken& cancel = {});

/// The same of what lies directly in these folders, whose names are told from `path`. Folders that are not
/// there hold nothing.
Result<Study> openFolders(const std::string& path, const std::vector<std::string>& folders,
                          const Progress& progress = {}, const CancelToken& cancel = {});

/// What these files hold, as if they were all that is in a folder. An Error only where it was cancelled.
Result<Study> openFiles(const std::vector<std::string>& files, const Progress& progress = {},
                        const CancelToken& cancel = {});

}  // namespace volumen
