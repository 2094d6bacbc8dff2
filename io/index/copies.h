#pragma once

#include "io/index/files_below.h"
#include "io/index/index.h"

namespace volumen {

/// The files that were copied, and those that were not.
struct Copies {
  std::vector<std::string> files;  ///< copies in the managed folder, including those already there
  std::vector<Refused> refused;
  std::vector<Refused> lacking;    ///< among `notImages`: files that series may lack
  int notImages = 0;               ///< number of other files, not copied
  std::vector<std::string> empty;  ///< roots without files
  Status status;                   ///< reason for an early end
};

/// Copies every file below the roots that belongs to a series to `managedFolder`/PATIENT/STUDY/SERIES/. Files
/// with bytes that are already there are not copied again.
Copies copyStudies(const std::vector<ImportRoot>& roots, const std::string& indexFolder,
                   const std::string& managedFolder, const Progress& progress, const CancelToken& cancel);

}  // namespace volumen
