#pragma once

#include <string>
#include <vector>

#include "io/study/progress.h"
#include "io/study/study.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// Opens a path: a file, a folder, a DICOMDIR, a zip archive or a path into one ("a.zip/CT"), or
/// "phantom:NAME[:SIZE]".
/// Folders are searched recursively; links to files are followed, links to folders only within the path, and
/// each file counts once. A DICOMDIR stands for all files below its folder, without links out of it. Archives
/// are unpacked until the program ends.
/// Reads headers only. The Error: the path does not exist. Files that cannot be loaded are in `refused` with
/// the reason.
Result<Study> openStudy(const std::string& path, const Progress& progress = {},
                        const CancelToken& cancel = {});

/// Opens the files directly in these folders. Names are relative to `path`; missing folders are empty.
Result<Study> openFolders(const std::string& path, const std::vector<std::string>& folders,
                          const Progress& progress = {}, const CancelToken& cancel = {});

/// Opens these files as if they were one folder's contents. The Error: only if cancelled.
Result<Study> openFiles(const std::vector<std::string>& files, const Progress& progress = {},
                        const CancelToken& cancel = {});

}  // namespace volumen
