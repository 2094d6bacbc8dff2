#pragma once

#include "io/dicom/header.h"
#include "io/study/progress.h"
#include "io/study/series.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The headers of a file.
struct LookedAt {
  bool isImageFile = false;     ///< true for NRRD, NIfTI, ... (looksLikeImageFile())
  std::vector<Series> volumes;  ///< volumes of an image file
  std::string problem;          ///< why an image file cannot be read: a sentence
  bool gzippedDicom = false;    ///< true if an unreadable file is a gzipped DICOM file
  dicom::Inspection dicom;      ///< result for all other files
};

/// Reads the headers of files, one entry each, on all cores, in workers if there are any (io/worker). Entries
/// of an interrupted search are empty.
std::vector<LookedAt> lookAtFiles(const std::vector<std::string>& paths, const Progress& progress,
                                  const CancelToken& cancel);

}  // namespace volumen
