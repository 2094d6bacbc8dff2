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
  int written = 0;               ///< files
  int alreadyThere = 0;          ///< that were written before, with the same bytes
  int twice = 0;                 ///< files that hold the same as another one
  int notDicom = 0;              ///< files of other kinds, which are left out
  std::vector<Refused> leftOut;  ///< DICOM files that are not written, with the reason
  // Series, by the folders of their files, in which a person may still be recognised.
  std::vector<std::string> withText;       ///< texts may be burned into the pixels
  std::vector<std::string> withFaces;      ///< pictures of a head
  std::vector<std::string> withoutSuv;     ///< PET that has lost its SUV
  std::vector<std::string> withoutMosaic;  ///< Siemens mosaics that are no volume any more
  std::vector<std::string> faceless;       ///< series of heads whose face was taken away
};

/// Writes de-identified copies of DICOM files to `folder`, as STUDY/SERIES/INSTANCE.dcm with names of our
/// own. Files that are there are never replaced. The Error: the folder cannot be
/// written, or the user cancelled. Copies that were complete by then stay; `complete`, if any, receives how
/// many are in the folder in every case. A folder that is made for them goes again if there are none.
Result<DeidentifyReport> deidentifyFiles(const std::vector<std::string>& files, const std::string& folder,
                                         const Deidentification& how, const Progress& progress,
                                         const CancelToken& cancel, int* complete = nullptr);

}  // namespace volumen
