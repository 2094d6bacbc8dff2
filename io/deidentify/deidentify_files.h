#pragma once

#include <string>
#include <vector>

#include "io/deidentify/deidentify_file.h"
#include "io/study/progress.h"
#include "io/study/unread.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

struct DeidentifyReport {
  int written = 0;               ///< number of new copies
  int alreadyThere = 0;          ///< number of copies that an earlier run wrote, with the same bytes
  int twice = 0;                 ///< number of files that repeat another file
  int notDicom = 0;              ///< number of files that are not DICOM and are left out
  std::vector<Refused> leftOut;  ///< DICOM files that are not copied, with the reason
  // Paths of series folders in the output that users should know about.
  std::vector<std::string> withText;       ///< texts may be burned into the pixels
  std::vector<std::string> withFaces;      ///< a face may be recognised in a rendering
  std::vector<std::string> withoutSuv;     ///< PET whose SUV cannot be computed any more
  std::vector<std::string> withoutMosaic;  ///< Siemens mosaics that cannot be read as volumes any more
  std::vector<std::string> faceless;       ///< heads whose face was removed
};

/// Writes de-identified copies of DICOM files to `folder`, as STUDY/SERIES/INSTANCE.dcm with names made from
/// the new UIDs. Existing files are never replaced. Returns an Error if the folder cannot be written or the
/// user cancelled. Copies that were complete by then stay. `complete`, if given, receives the number of
/// copies in the folder, also if the user cancelled. A folder that was made for the copies is removed if
/// there are none.
Result<DeidentifyReport> deidentifyFiles(const std::vector<std::string>& files, const std::string& folder,
                                         const Deidentification& how, const Progress& progress,
                                         const CancelToken& cancel, int* complete = nullptr);

}  // namespace volumen
