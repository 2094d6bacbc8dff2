#pragma once

#include "io/dicom/header.h"
#include "io/study/progress.h"
#include "io/study/series.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// What the headers of a file say.
struct LookedAt {
  bool isImageFile = false;     ///< NRRD, NIfTI, ...: looksLikeImageFile(); then:
  std::vector<Series> volumes;  ///< what it holds
  std::string problem;          ///< or why that cannot be read: a sentence
  bool gzippedDicom = false;    ///< what cannot be read is a DICOM file in gzip
  dicom::Inspection dicom;      ///< of other files
};

/// Looks at files, one entry each, on all cores, in workers where there are any (io/worker). Entries of an
/// interrupted search are empty.
std::vector<LookedAt> lookAtFiles(const std::vector<std::string>& paths, const Progress& progress,
                                  const CancelToken& cancel);

}  // namespace volumen
