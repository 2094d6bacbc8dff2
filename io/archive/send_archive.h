#pragma once

#include <string>
#include <vector>

#include "io/archive/archives.h"
#include "io/study/progress.h"
#include "io/study/unread.h"
#include "viewer/volume/cancel.h"

namespace volumen {

struct SendReport {
  int instances = 0;              ///< DICOM instances among the files
  int sent = 0;                   ///< that the archive keeps
  std::vector<Refused> failed;    ///< the others, with the reason
  std::vector<Refused> notDicom;  ///< files that hold no instance
};

/// Sends files to an archive (C-STORE, STOW-RS). Two files with the same instance are sent once. The Error:
/// nothing was sent.
Result<SendReport> sendToArchive(const Archive& archive, const std::vector<std::string>& files,
                                 const Progress& progress, const CancelToken& cancel);

}  // namespace volumen
