#pragma once

#include "io/index/files_below.h"
#include "io/index/index.h"

namespace volumen {

/// Which files were copied to where, and what was not copied.
struct Copies {
  std::vector<std::string> files;  ///< in the managed folder, those that were there before, too
  std::vector<Refused> refused;
  std::vector<Refused> lacking;    ///< among `notImages`: what series may lack
  int notImages = 0;               ///< how many others were not copied
  std::vector<std::string> empty;  ///< of the roots those where no file was found
  Status status;                   ///< why it ended early
};

/// Copies every file below the roots that is part of a series to `managedFolder`/PATIENT/STUDY/SERIES/. A
/// file whose bytes are there already is not copied again.
Copies copyStudies(const std::vector<ImportRoot>& roots, const std::string& indexFolder,
                   const std::string& managedFolder, const Progress& progress, const CancelToken& cancel);

}  // namespace volumen
