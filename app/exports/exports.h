#pragma once

#include <string>
#include <vector>

#include "io/study/unread.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// What `volumen export --as` writes: PATH, the file, and the values of the options of formats.
struct ExportJob {
  std::string path, output, series;
  std::string shapes, images, title, segments;
};

/// What was written.
struct Exported {
  std::vector<std::string> notes{};  ///< sentences for the user
  std::vector<Unread> unread{};      ///< files that could not be read
};

/// Each writes the file of a job in one format (exportFormats()). The Error is a sentence for the user.
Result<Exported> exportReport(const ExportJob& job, const CancelToken& cancel);
Result<Exported> exportKeyObjects(const ExportJob& job, const CancelToken& cancel);
Result<Exported> exportStructureSet(const ExportJob& job, const CancelToken& cancel);

}  // namespace volumen
