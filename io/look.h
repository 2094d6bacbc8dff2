#pragma once

#include "io/dicom/header.h"
#include "io/study/progress.h"
#include "io/study/series.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// The headers of a file.
struct LookedAt {
  bool isImageFile = false;     ///< NRRD, NIfTI, ... (looksLikeImageFile()); then:
  std::vector<Series> volumes;  ///< its contents
  std::string problem;          ///< or the reason why it cannot be read: a sentence
  bool gzippedDicom = false;    ///< an unreadable file is a gzipped DICOM file
  dicom::Inspection dicom;      ///< for other files
};

/// Reads the headers of files, one entry each, on all cores, in workers if there are any (io/worker). Entries
/// of an interrupted search are empty.
std::vector<LookedAt> lookAtFiles(const std::vector<std::string>& paths, const Progress& progress,
                                  const CancelToken& cancel);

}  // namespace volumen
